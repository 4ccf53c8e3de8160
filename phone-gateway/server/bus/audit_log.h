#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "common/rate_limiter.h"
#include "phone-gateway/server/core/audit_event.h"

namespace nao::gateway {

/** An event as one line of JSON.
 * @param num_kept_back  Earlier refusals of the same kind that were not written; 0: left out. */
std::string to_json(const AuditEvent& event, int64_t wall_utime, int64_t num_kept_back);

/** Writes who connected, who drove and who was refused to the program's log and, as JSON lines, to
 * a file. The same refusal of the same address is written at most once in ten seconds. */
class AuditLog {
 public:
  /** @param file  Lines are appended to it; empty: program's log only.
   * @throws Error  if it cannot be opened. */
  explicit AuditLog(const std::string& file);

  /** @param now  s of a clock that never runs backwards. */
  void write(const AuditEvent& event, double now, int64_t wall_utime);

 private:
  /** @return How many were kept back before; nothing if this one is kept back, too. */
  std::optional<int64_t> allow(const AuditEvent& event, double now);

  std::ofstream file_;
  std::map<std::string, RateLimiter> refusals_;
};

}  // namespace nao::gateway
