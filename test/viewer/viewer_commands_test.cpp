#include "viewer/viewer_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <naolcm/command_result_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "common/bus.h"
#include "common/wall_clock.h"

namespace nao::viewer {
namespace {

class ViewerCommandsTest : public testing::Test {
 protected:
  ViewerCommandsTest() : bus_("memq://"), sender_(bus_, RobotChannels("NAO")) {
    bus_.subscribe<naolcm::posture_command_t>(
        "NAO_POSTURE_COMMAND", Bus::Queue::kAll,
        [this](const naolcm::posture_command_t& command) { postures_.push_back(command); });
    bus_.subscribe<naolcm::walk_command_t>(
        "NAO_WALK_COMMAND", Bus::Queue::kAll,
        [this](const naolcm::walk_command_t& command) { walks_.push_back(command); });
    bus_.subscribe<naolcm::world_command_t>(
        kWorldCommandChannel, Bus::Queue::kAll,
        [this](const naolcm::world_command_t& command) { worlds_.push_back(command); });
  }

  void deliver() {
    while (bus_.handle_for(0)) {
    }
  }

  /** Repeats as the viewer does, over some seconds of its clock. */
  void advance(double seconds) {
    for (const double end = now_ + seconds; now_ < end; now_ += 0.02) sender_.repeat(now_);
    deliver();
  }

  Bus bus_;
  ViewerCommands sender_;
  double now_ = monotonic_seconds();
  std::vector<naolcm::posture_command_t> postures_;
  std::vector<naolcm::walk_command_t> walks_;
  std::vector<naolcm::world_command_t> worlds_;
};

TEST_F(ViewerCommandsTest, RepeatsACommandUnchangedUntilItIsAcknowledged) {
  sender_.go_to_posture("Crouch", 0.5);
  advance(0.5);
  ASSERT_GE(postures_.size(), 4u);
  EXPECT_LE(postures_.size(), 7u);
  for (const auto& command : postures_) {
    EXPECT_EQ(command.posture, "Crouch");
    EXPECT_EQ(command.command_id, postures_[0].command_id);
  }
  naolcm::command_result_t result{};
  result.source = postures_[0].source;
  result.command_id = postures_[0].command_id + 1;
  sender_.receive(result);
  const size_t before = postures_.size();
  advance(0.5);
  EXPECT_GT(postures_.size(), before) << "the result of another command";
  result.command_id = postures_[0].command_id;
  sender_.receive(result);
  const size_t acknowledged = postures_.size();
  advance(1.0);
  EXPECT_EQ(postures_.size(), acknowledged);
}

TEST_F(ViewerCommandsTest, ReportsATimeoutWithoutAnAnswer) {
  sender_.send_world_command("pause");
  advance(3.0);
  EXPECT_EQ(sender_.last_outcome(), "pause: no answer");
  const size_t num_sent = worlds_.size();
  advance(1.0);
  EXPECT_EQ(worlds_.size(), num_sent);
}

TEST_F(ViewerCommandsTest, ReportsTheAnswerOfTheSimulator) {
  sender_.push("NAO", "torso", {1, 0, 0});
  deliver();
  ASSERT_EQ(worlds_.size(), 1u);
  EXPECT_DOUBLE_EQ(worlds_[0].impulse_in_world[0], 1);
  naolcm::world_truth_t truth{};
  truth.last_command_source = worlds_[0].source;
  truth.last_command_id = worlds_[0].command_id;
  truth.last_command_error = "no link \"torso\"";
  sender_.receive(truth);
  EXPECT_EQ(sender_.last_outcome(), "push: no link \"torso\"");
}

TEST_F(ViewerCommandsTest, RepeatsOnlyTheLastPlacementOfTheBall) {
  sender_.place_ball(1, 0);
  sender_.place_ball(2, 0);
  deliver();
  worlds_.clear();
  advance(1.0);
  ASSERT_GE(worlds_.size(), 2u);
  for (const auto& command : worlds_) EXPECT_DOUBLE_EQ(command.position_in_world[0], 2);
}

TEST_F(ViewerCommandsTest, SendsAWalkAsOneCommand) {
  sender_.walk(0.1, 0, 0);
  sender_.walk(0.2, 0, 0);
  advance(0.3);
  ASSERT_GE(walks_.size(), 3u) << "it is repeated";
  EXPECT_EQ(walks_.back().vx, 0.2);
  EXPECT_EQ(walks_.front().command_id, walks_.back().command_id);
  sender_.end_walk();
  sender_.walk(0.1, 0, 0);
  advance(0.3);
  EXPECT_NE(walks_.front().command_id, walks_.back().command_id);
  EXPECT_EQ(walks_.back().vx, 0.1) << "the end of the first walk is not repeated any more";
}

TEST_F(ViewerCommandsTest, EndsAWalkWithVelocitiesOfZero) {
  sender_.end_walk();
  sender_.walk(0.1, 0.2, 0.3);
  sender_.end_walk();
  sender_.end_walk();
  advance(1.0);
  ASSERT_EQ(walks_.size(), 4u) << "the bus may lose messages";
  for (size_t i = 1; i < walks_.size(); ++i) {
    EXPECT_EQ(walks_[i].command_id, walks_[0].command_id);
    EXPECT_EQ(walks_[i].vx, 0);
    EXPECT_EQ(walks_[i].vy, 0);
    EXPECT_EQ(walks_[i].wz, 0);
  }
}

}  // namespace
}  // namespace nao::viewer
