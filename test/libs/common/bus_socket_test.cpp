#include "common/bus_socket.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <naolcm/stop_command_t.hpp>
#include <string>
#include <vector>

#include "common/bus.h"
#include "test/support/num_waits.h"

namespace nao {
namespace {

std::vector<uint8_t> bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

TEST(BusSocket, ReadsAWholeMessage) {
  const auto datagram = bytes_of(std::string("LC02\0\0\0\1CHANNEL\0content", 23));
  const auto message = parse_datagram(datagram);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->channel, "CHANNEL");
  EXPECT_EQ(std::string(message->bytes.begin(), message->bytes.end()), "content");
}

TEST(BusSocket, LeavesFragmentsAndDamagedDatagrams) {
  EXPECT_FALSE(parse_datagram(bytes_of(std::string("LC03\0\0\0\1CHANNEL\0content", 23))));
  EXPECT_FALSE(parse_datagram(bytes_of(std::string("LC02\0\0\0\1CHANNEL", 15))));
  EXPECT_FALSE(parse_datagram(bytes_of("LC02")));
  EXPECT_FALSE(parse_datagram({}));
}

/** A bus of this process, and a sender on it. */
class BusSocketTest : public testing::Test {
 protected:
  BusSocketTest()
      : url_("udpm://239.255.76.67:" + std::to_string(30000 + getpid() % 2000) + "?ttl=0"),
        receiver_(url_),
        sender_(url_) {}

  void send(const std::string& channel, int id, const std::string& source = "") {
    naolcm::stop_command_t message;
    message.wall_utime = 0;
    message.command_id = id;
    message.source = source;
    sender_.publish(channel, message);
  }
  void receive(const std::string& channel, Bus::Queue queue) {
    receiver_.subscribe<naolcm::stop_command_t>(
        channel, queue, [this](const naolcm::stop_command_t& message) {
          ids_.push_back(static_cast<int>(message.command_id));
        });
  }

  const std::string url_;
  Bus receiver_;
  Bus sender_;
  std::vector<int> ids_;
};

/** How often the threads of this process but the first have waited. */
int num_waits_of_other_threads() {
  int sum = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    const int thread_id = std::stoi(task.path().filename().string());
    if (thread_id != getpid()) sum += num_waits(thread_id);
  }
  return sum;
}

TEST_F(BusSocketTest, AMessageWakesOneThreadOnly) {
  receive("STOP", Bus::Queue::kAll);
  const int before = num_waits_of_other_threads();
  for (int i = 0; i < 100; ++i) {
    send("STOP", i);
    ASSERT_TRUE(receiver_.handle_for(2));
  }
  EXPECT_LT(num_waits_of_other_threads() - before, 20);
}

TEST_F(BusSocketTest, OfAStateTheNewestIsHandledAndOfEventsAllInTheirOrder) {
  receive("STATE", Bus::Queue::kLatest);
  receive("EVENT", Bus::Queue::kAll);
  send("STATE", 1);
  send("EVENT", 2);
  send("STATE", 3);
  send("EVENT", 4);
  while (ids_.size() < 3) ASSERT_TRUE(receiver_.handle_for(2));
  EXPECT_FALSE(receiver_.handle_for(0));
  EXPECT_EQ(ids_, (std::vector<int>{2, 3, 4}));
}

TEST_F(BusSocketTest, AMessageInFragmentsArrivesOnce) {
  receive("STOP", Bus::Queue::kAll);
  send("STOP", 1, std::string(100'000, 'x'));
  while (ids_.empty()) ASSERT_TRUE(receiver_.handle_for(2));
  send("STOP", 2);
  while (ids_.size() < 2) ASSERT_TRUE(receiver_.handle_for(2));
  EXPECT_EQ(ids_, (std::vector<int>{1, 2}));
}

TEST_F(BusSocketTest, WholeMessagesAndFragmentsAreHandledTogether) {
  receive("STOP", Bus::Queue::kAll);
  send("STOP", 1, std::string(100'000, 'x'));
  for (int i = 2; i <= 100; ++i) send("STOP", i);
  while (ids_.size() < 100) {
    pollfd polled{receiver_.descriptor(), POLLIN, 0};
    ASSERT_EQ(poll(&polled, 1, 2000), 1);
    receiver_.handle();
  }
  pollfd polled{receiver_.descriptor(), POLLIN, 0};
  EXPECT_EQ(poll(&polled, 1, 0), 0) << "nothing is left";
  std::sort(ids_.begin(), ids_.end());
  EXPECT_EQ(ids_.front(), 1);
  EXPECT_EQ(ids_.back(), 100);
}

TEST_F(BusSocketTest, BesideAPatternEachMessageArrivesOnce) {
  receive("STOP", Bus::Queue::kAll);
  int num_raw = 0;
  receiver_.subscribe_raw("ST.*", [&](const RawMessage&) { ++num_raw; });
  for (int i = 0; i < 5; ++i) send("STOP", i);
  while (ids_.size() < 5 || num_raw < 5) ASSERT_TRUE(receiver_.handle_for(2));
  EXPECT_FALSE(receiver_.handle_for(0.05));
  EXPECT_EQ(ids_.size(), 5u);
}

}  // namespace
}  // namespace nao
