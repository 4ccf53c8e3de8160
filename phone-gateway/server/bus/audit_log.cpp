#include "phone-gateway/server/bus/audit_log.h"

#include "common/error.h"
#include "common/json_writer.h"
#include "common/logger.h"

namespace nao::gateway {
namespace {

/** Time in which the same refusal of one address is written once, s. Chosen: an attack that lasts
 * an hour makes 360 lines. */
constexpr double kRefusalPeriod = 10;
/** Pairs of address and reason whose repetitions are counted. Chosen: bounds memory against many
 * addresses. */
constexpr size_t kMaxRefusals = 256;

}  // namespace

std::string to_json(const AuditEvent& event, int64_t wall_utime, int64_t num_kept_back) {
  JsonWriter json;
  json.begin_object();
  json.add("wall_utime", wall_utime);
  json.add("event", event.event);
  json.add("client_id", int64_t{event.client_id});
  json.add("name", event.name);
  json.add("address", event.address);
  json.add("detail", event.detail);
  if (num_kept_back > 0) json.add("num_kept_back", num_kept_back);
  return json.take();
}

AuditLog::AuditLog(const std::string& file) {
  if (file.empty()) return;
  file_.open(file, std::ios::app);
  if (!file_) throw Error("cannot write the audit log " + file);
}

void AuditLog::write(const AuditEvent& event, double now, int64_t wall_utime) {
  const auto num_kept_back = allow(event, now);
  if (!num_kept_back) return;
  const std::string json = to_json(event, wall_utime, *num_kept_back);
  logger::info("audit {}", json);
  if (file_.is_open()) file_ << json << std::endl;
}

std::optional<int64_t> AuditLog::allow(const AuditEvent& event, double now) {
  if (event.event != "refused") return 0;
  if (refusals_.size() >= kMaxRefusals) refusals_.clear();
  return refusals_.try_emplace(event.address + " " + event.detail, RateLimiter(kRefusalPeriod))
      .first->second.allow(now);
}

}  // namespace nao::gateway
