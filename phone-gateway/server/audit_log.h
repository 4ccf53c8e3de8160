#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "common/rate_limiter.h"
#include "phone-gateway/server/gateway_core.h"

namespace nao {

/** An event as one line of JSON, whatever characters a client put into its name. */
std::string to_json(const AuditEvent& event, int64_t wall_utime, int64_t num_kept_back);

/** Who connected, who drove, who was refused: to the log, and to a file of JSON lines if one is
 * named. The same refusal of the same address is written at most every ten seconds. */
class AuditLog {
 public:
  /** @param file  Lines are appended; empty: the log only.
   * @throws Error  if it cannot be opened. */
  explicit AuditLog(const std::string& file);

  /** @param now  s of a clock that never runs backwards. */
  void write(const AuditEvent& event, double now, int64_t wall_utime);

 private:
  /** @return How many were kept back before; nothing if this one is. */
  std::optional<int64_t> allow(const AuditEvent& event, double now);

  std::ofstream file_;
  std::map<std::string, RateLimiter> refusals_;
};

}  // namespace nao
