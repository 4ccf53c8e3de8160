#include "common/second_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <naolcm/daemon_status_t.hpp>

namespace nao {
namespace {

class SecondProcessTest : public testing::Test {
 protected:
  void hear(const std::string& program, const std::string& host, int process,
            int64_t num_messages_out = 0, int64_t age = 0) {
    naolcm::daemon_status_t status{};
    status.wall_utime = wall_utime() - age;
    status.num_messages_out = num_messages_out;
    status.program = program;
    status.host = host;
    status.process_id = process;
    bus_.publish("DAEMON_STATUS", status);
    while (bus_.handle_for(0)) {
    }
  }

  Bus bus_{"memq://"};
  double now_ = 10;
  SecondProcess second_{bus_, "nao-sim", "", [this] { return now_; }};
};

TEST_F(SecondProcessTest, IsNamedUntilItIsSilent) {
  hear("nao-sim", "pc", 12);
  EXPECT_EQ(second_.describe(), "a second nao-sim is on this bus: host pc, process 12");
  now_ += 3;
  EXPECT_EQ(second_.describe(), "");
}

TEST_F(SecondProcessTest, IsNeitherThisOneNorAnotherProgram) {
  std::array<char, 256> host{};
  ASSERT_EQ(gethostname(host.data(), host.size() - 1), 0);
  hear("nao-sim", host.data(), getpid());
  hear("nao-motion", "pc", 12);
  EXPECT_EQ(second_.describe(), "");
  // A process id says nothing about another host.
  hear("nao-sim", "pc", getpid());
  EXPECT_NE(second_.describe(), "");
}

TEST_F(SecondProcessTest, WasFirstIfItHadSentMoreWhenThisOneBegan) {
  hear("nao-sim", "pc", 12, 0);
  EXPECT_FALSE(second_.was_first());
  hear("nao-sim", "pc", 12, 1000);
  EXPECT_TRUE(second_.was_first());
}

TEST_F(SecondProcessTest, WasNotFirstInARecordingOrWhenNetworksAreJoinedLater) {
  hear("nao-sim", "pc", 12, 1000, 3600'000'000);
  EXPECT_FALSE(second_.was_first());
  now_ += 10;
  hear("nao-sim", "pc", 12, 1000);
  EXPECT_FALSE(second_.was_first());
}

TEST_F(SecondProcessTest, OfARobotIgnoresThoseOfOtherRobots) {
  SecondProcess of_robot(bus_, "nao-motion", "NAO", [this] { return now_; });
  hear("nao-motion", "pc", 12, 1000);
  EXPECT_EQ(of_robot.describe(), "");
}

}  // namespace
}  // namespace nao
