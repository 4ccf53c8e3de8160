#include "phone-gateway/relay/relay_core.h"

#include <gtest/gtest.h>

namespace nao::relay {
namespace {

class RelayCoreTest : public testing::Test {
 protected:
  RelayCore make(const RelayLimits& limits = {}) {
    return {limits, [this] { return "ticket " + std::to_string(++num_tickets_); }};
  }
  static bool is_refused(const std::variant<RelayCore::Waiting, RelayCore::Refused>& added) {
    return std::holds_alternative<RelayCore::Refused>(added);
  }
  static RelayCore::Waiting waiting(
      const std::variant<RelayCore::Waiting, RelayCore::Refused>& added) {
    return std::get<RelayCore::Waiting>(added);
  }

  int num_tickets_ = 0;
};

TEST_F(RelayCoreTest, ATicketFetchesItsPhoneOnce) {
  RelayCore core = make();
  ASSERT_TRUE(std::holds_alternative<uint32_t>(core.add_robot("nao", "a")));
  const auto first = waiting(core.add_phone("nao", "b", 0));
  const auto second = waiting(core.add_phone("nao", "b", 0));
  EXPECT_EQ(core.take_ticket(second.ticket), second.phone);
  EXPECT_EQ(core.take_ticket(second.ticket), 0u);
  EXPECT_EQ(core.take_ticket(first.ticket), first.phone);
  EXPECT_EQ(core.take_ticket(""), 0u);
  EXPECT_EQ(core.take_ticket("guessed"), 0u);
}

TEST_F(RelayCoreTest, APhoneWithoutItsRobotIsRefused) {
  RelayCore core = make();
  EXPECT_TRUE(is_refused(core.add_phone("nao", "b", 0)));
  const auto number = std::get<uint32_t>(core.add_robot("nao", "a"));
  EXPECT_FALSE(is_refused(core.add_phone("nao", "b", 0)));
  core.remove_robot("nao", number);
  EXPECT_TRUE(is_refused(core.add_phone("nao", "b", 0)));
}

TEST_F(RelayCoreTest, ANewConnectionOfARobotReplacesTheOldOne) {
  RelayCore core = make();
  const auto old = std::get<uint32_t>(core.add_robot("nao", "a"));
  const auto now = std::get<uint32_t>(core.add_robot("nao", "c"));
  EXPECT_EQ(core.robot_connection("nao"), now);
  // The end of the old one comes late.
  core.remove_robot("nao", old);
  EXPECT_EQ(core.robot_connection("nao"), now);
  EXPECT_EQ(core.num_robots(), 1u);
}

TEST_F(RelayCoreTest, EverythingIsBounded) {
  RelayLimits limits;
  limits.max_robots = 2;
  limits.max_robots_per_address = 1;
  limits.max_phones = 4;
  limits.max_phones_per_robot = 3;
  limits.max_phones_per_address = 2;
  RelayCore core = make(limits);
  const auto is_robot_refused = [&](const char* robot, const char* address) {
    return std::holds_alternative<RelayCore::Refused>(core.add_robot(robot, address));
  };
  EXPECT_FALSE(is_robot_refused("one", "a"));
  EXPECT_TRUE(is_robot_refused("two", "a"));
  EXPECT_FALSE(is_robot_refused("two", "b"));
  EXPECT_TRUE(is_robot_refused("three", "c"));
  // A robot that comes back needs no place.
  EXPECT_FALSE(is_robot_refused("one", "b"));
  const auto first = waiting(core.add_phone("one", "a", 0));
  EXPECT_FALSE(is_refused(core.add_phone("one", "a", 0)));
  EXPECT_TRUE(is_refused(core.add_phone("one", "a", 0)));
  EXPECT_FALSE(is_refused(core.add_phone("one", "b", 0)));
  EXPECT_TRUE(is_refused(core.add_phone("one", "c", 0)));
  EXPECT_FALSE(is_refused(core.add_phone("two", "c", 0)));
  EXPECT_TRUE(is_refused(core.add_phone("two", "d", 0)));
  core.remove_phone(first.phone);
  EXPECT_FALSE(is_refused(core.add_phone("two", "d", 0)));
}

TEST_F(RelayCoreTest, APhoneWaitsAShortTimeOnly) {
  RelayLimits limits;
  limits.ticket_timeout = 5;
  RelayCore core = make(limits);
  (void)core.add_robot("nao", "a");
  const auto fetched = waiting(core.add_phone("nao", "b", 10));
  const auto left = waiting(core.add_phone("nao", "b", 10));
  EXPECT_EQ(core.take_ticket(fetched.ticket), fetched.phone);
  EXPECT_TRUE(core.late_phones(15).empty());
  EXPECT_EQ(core.late_phones(15.1), std::vector<uint32_t>{left.phone});
}

}  // namespace
}  // namespace nao::relay
