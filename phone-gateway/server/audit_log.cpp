#include "phone-gateway/server/audit_log.h"

#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>

#include "common/error.h"

namespace nao {
namespace {

constexpr double kRefusalPeriod = 10;
constexpr size_t kMaxRefusals = 256;

std::string quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') {
      std::array<char, 8> code{};
      std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(c));
      quoted += code.data();
    } else {
      quoted.push_back(c);
    }
  }
  return quoted + "\"";
}

}  // namespace

std::string to_json(const AuditEvent& event, int64_t wall_utime, int64_t num_kept_back) {
  std::string json =
      "{\"wall_utime\": " + std::to_string(wall_utime) + ", \"event\": " + quote(event.event) +
      ", \"client_id\": " + std::to_string(event.client_id) + ", \"name\": " + quote(event.name) +
      ", \"address\": " + quote(event.address) + ", \"detail\": " + quote(event.detail);
  if (num_kept_back > 0) json += ", \"num_kept_back\": " + std::to_string(num_kept_back);
  return json + "}";
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
  spdlog::info("audit {}", json);
  if (file_.is_open()) file_ << json << std::endl;
}

std::optional<int64_t> AuditLog::allow(const AuditEvent& event, double now) {
  if (event.event != "refused") return 0;
  if (refusals_.size() >= kMaxRefusals) refusals_.clear();
  return refusals_.try_emplace(event.address + " " + event.detail, RateLimiter(kRefusalPeriod))
      .first->second.allow(now);
}

}  // namespace nao
