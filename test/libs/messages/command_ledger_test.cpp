#include "messages/command_ledger.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

TEST(CommandLedger, KeepsTheLatestResultOfACommand) {
  CommandLedger ledger;
  ledger.note({"a", 1, CommandKind::kWalk, ResultStatus::kAccepted});
  ledger.note({"a", 1, CommandKind::kWalk, ResultStatus::kFailed, {"balance-lost"}});
  ASSERT_NE(ledger.find("a", 1), nullptr);
  EXPECT_EQ(ledger.find("a", 1)->status, ResultStatus::kFailed);
  EXPECT_EQ(ledger.find("a", 1)->reason, Reason("balance-lost"));
  EXPECT_EQ(ledger.find("b", 1), nullptr);
  EXPECT_EQ(ledger.size(), 1u);
}

TEST(CommandLedger, DropsTheOldestEndedCommandFirst) {
  CommandLedger ledger(3);
  ledger.note({"a", 1, CommandKind::kPosture, ResultStatus::kAccepted});
  for (int64_t id = 2; id <= 10; ++id) {
    ledger.note({"a", id, CommandKind::kStop, ResultStatus::kRefused});
    EXPECT_LE(ledger.size(), 3u);
  }
  EXPECT_NE(ledger.find("a", 1), nullptr);
  EXPECT_EQ(ledger.find("a", 2), nullptr);
  EXPECT_NE(ledger.find("a", 10), nullptr);
}

}  // namespace
}  // namespace nao
