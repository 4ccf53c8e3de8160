#include "phone-gateway/server/bus/audit_log.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/error.h"
#include "test/support/temporary_folder.h"

namespace nao::gateway {
namespace {

TEST(AuditLog, WritesAnEventAsOneLineWhateverItsName) {
  const AuditEvent event{"connected", 3, "An\"a\\\n\x1b", "10.0.0.1", "Firefox"};
  EXPECT_EQ(to_json(event, 5, 0),
            R"({"wall_utime":5,"event":"connected","client_id":3,"name":"An\"a\\\n\u001b",)"
            R"("address":"10.0.0.1","detail":"Firefox"})");
}

TEST(AuditLog, ReplacesBytesThatAreNoText) {
  const std::string json = to_json({"connected", 3, "An\xc3", "", ""}, 5, 0);
  EXPECT_NE(json.find("An\xef\xbf\xbd"), std::string::npos) << json;
}

TEST(AuditLog, KeepsBackRepeatedRefusalsAndCountsThem) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "audit.jsonl";
  AuditLog log(file);
  const AuditEvent refusal{"refused", 1, "", "10.0.0.1", "token-wrong"};
  for (int i = 0; i < 100; ++i) log.write(refusal, i * 0.01, 0);
  log.write({"refused", 1, "", "10.0.0.2", "token-wrong"}, 1, 0);
  log.write(refusal, 11, 0);
  const std::string text = read_text(file);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_NE(text.find("\"num_kept_back\":99"), std::string::npos);
}

TEST(AuditLog, ThrowsIfTheFileCannotBeOpened) {
  EXPECT_THROW(AuditLog("/nowhere/audit.jsonl"), Error);
}

}  // namespace
}  // namespace nao::gateway
