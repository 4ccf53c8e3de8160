#include "tools/simulation-server/simulation_core.h"

#include <google/protobuf/stubs/logging.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "common/data_path.h"
#include "common/error.h"
#include "common/random.h"

namespace nao::simulation_server {
namespace {

SimulationCore make_core() {
  static const auto model =
      std::make_shared<const RobotModel>(RobotModel::load(data_path() / "robots" / "nao"));
  ClosedLoopOptions options;
  options.model = model;
  options.disturbances =
      std::make_shared<sim::DisturbanceSet>(sim::DisturbanceSet::find("default"));
  return SimulationCore(options);
}

protocol::Request reset_request(uint64_t seed) {
  protocol::Request request;
  request.mutable_reset()->set_seed(seed);
  return request;
}

protocol::Request step_request(uint32_t num_ticks) {
  protocol::Request request;
  request.mutable_step()->set_num_ticks(num_ticks);
  return request;
}

TEST(SimulationCore, DescribesTheRobot) {
  SimulationCore core = make_core();
  protocol::Request request;
  request.mutable_describe();
  const auto description = core.handle(request).description();
  EXPECT_EQ(description.model(), "nao");
  EXPECT_EQ(description.engine(), "fast");
  EXPECT_EQ(description.disturbances(), "default");
  EXPECT_GT(description.joints_size(), 20);
  EXPECT_GT(description.foot_sensors_size(), 0);
  EXPECT_GT(description.max_vx(), 0);
  EXPECT_LT(description.min_vx(), 0);
}

TEST(SimulationCore, WalksAndReportsTheCommandOnce) {
  SimulationCore core = make_core();
  core.handle(reset_request(1));
  protocol::Request walk = step_request(500);
  walk.mutable_step()->add_commands()->mutable_walk()->set_vx(0.1);
  walk.mutable_step()->set_with_truth(true);
  const auto state = core.handle(walk).state();
  ASSERT_EQ(state.command_ids_size(), 1);
  ASSERT_EQ(state.results_size(), 1);
  EXPECT_EQ(state.results(0).command_id(), state.command_ids(0));
  EXPECT_GT(state.truth().torso_position(0), 0.2);
  EXPECT_NEAR(state.torso_position(0), state.truth().torso_position(0), 0.1);
  EXPECT_NEAR(state.time(), 5.01, 1e-9);
  // All zero ends the walk.
  protocol::Request stop = step_request(300);
  stop.mutable_step()->add_commands()->mutable_walk();
  const auto end = core.handle(stop).state();
  ASSERT_GE(end.results_size(), 1);
  EXPECT_EQ(end.results(end.results_size() - 1).status(),
            static_cast<uint32_t>(ResultStatus::kDone));
}

TEST(SimulationCore, GivesTheSameBytesForTheSameSeed) {
  const auto run = [](uint64_t seed) {
    SimulationCore core = make_core();
    std::string bytes = core.handle(reset_request(seed).SerializeAsString());
    protocol::Request walk = step_request(200);
    walk.mutable_step()->add_commands()->mutable_walk()->set_vx(0.1);
    bytes += core.handle(walk.SerializeAsString());
    return bytes + core.handle(step_request(100).SerializeAsString());
  };
  EXPECT_EQ(run(5), run(5));
  EXPECT_NE(run(5), run(6));
}

TEST(SimulationCore, FollowsJointTargetsAndGivesTheRobotBack) {
  SimulationCore core = make_core();
  auto state = core.handle(reset_request(1)).state();
  protocol::Request step = step_request(100);
  auto& targets = *step.mutable_step()->mutable_joint_targets();
  *targets.mutable_position() = state.joint_target();
  // HeadYaw is the first joint of NAO.
  targets.set_position(0, 0.3);
  state = core.handle(step).state();
  EXPECT_NEAR(state.joint_position(0), 0.3, 0.05);
  EXPECT_EQ(state.joint_target(0), 0.3);
  // Beyond a limit it is clipped.
  targets.set_position(0, 6);
  EXPECT_LT(core.handle(step).state().joint_target(0), 2.2);
  targets.set_position(0, 0);
  core.handle(step);
  // The motion core stands the robot where it is.
  step = step_request(300);
  step.mutable_step()->set_with_truth(true);
  state = core.handle(step).state();
  EXPECT_GT(state.truth().torso_position(2), 0.25);
}

TEST(SimulationCore, RefusesWhatItCannotExecuteAndKeepsTheWorld) {
  SimulationCore core = make_core();
  EXPECT_NE(core.handle(step_request(1)).error(), "");
  protocol::Request request;
  EXPECT_NE(core.handle(request).error(), "");
  const auto before = core.handle(reset_request(1)).state();

  request.mutable_reset()->set_posture("Handstand");
  EXPECT_NE(core.handle(request).error(), "");
  EXPECT_NE(core.handle(step_request(0)).error(), "");
  EXPECT_NE(core.handle(step_request(kMaxTicks + 1)).error(), "");
  request = step_request(1);
  request.mutable_step()->add_commands();
  EXPECT_NE(core.handle(request).error(), "");
  for (int i = 0; i < kMaxCommands; ++i) request.mutable_step()->add_commands()->mutable_stop();
  EXPECT_NE(core.handle(request).error(), "");

  request = step_request(1);
  auto& targets = *request.mutable_step()->mutable_joint_targets();
  EXPECT_NE(core.handle(request).error(), "") << "no targets";
  for (const double bad : {std::nan(""), HUGE_VAL, -180.0}) {
    *targets.mutable_position() = before.joint_target();
    targets.set_position(3, bad);
    EXPECT_NE(core.handle(request).error(), "") << bad;
  }
  *targets.mutable_position() = before.joint_target();
  targets.add_stiffness(1);
  EXPECT_NE(core.handle(request).error(), "") << "one stiffness";
  *targets.mutable_stiffness() = before.joint_target();
  targets.set_stiffness(0, 1.5);
  EXPECT_NE(core.handle(request).error(), "") << "stiffness above 1";

  EXPECT_NEAR(core.handle(step_request(1)).state().time(), before.time() + before.period(), 1e-9);
}

TEST(SimulationCore, ReportsCommandsThatTheMotionCoreRefuses) {
  SimulationCore core = make_core();
  core.handle(reset_request(1));
  protocol::Request request = step_request(20);
  auto& step = *request.mutable_step();
  auto& posture = *step.add_commands()->mutable_posture();
  posture.set_posture("Handstand");
  posture.set_speed(0.5);
  step.add_commands()->mutable_walk()->set_vx(std::nan(""));
  step.add_commands()->mutable_change_joints()->add_joint_names("Tail");
  const auto state = core.handle(request).state();
  EXPECT_EQ(state.command_ids_size(), 3);
  int num_refused = 0;
  for (const auto& result : state.results()) {
    if (result.status() != static_cast<uint32_t>(ResultStatus::kRefused)) continue;
    ++num_refused;
    EXPECT_NE(result.reason_code(), "");
    EXPECT_NE(result.reason(), "");
  }
  EXPECT_GE(num_refused, 3);
}

/** Sets a step to few ticks: long ones would only take time. */
std::string shortened(const std::string& bytes) {
  protocol::Request request;
  if (!request.ParseFromString(bytes) || !request.has_step()) return bytes;
  if (request.step().num_ticks() > 3) request.mutable_step()->set_num_ticks(3);
  return request.SerializeAsString();
}

TEST(SimulationCore, AnswersAnyBytes) {
  // It reports every text that is not UTF-8.
  const google::protobuf::LogSilencer silence;
  SimulationCore core = make_core();
  core.handle(reset_request(1));
  Random random(1);
  const auto byte = [&] { return static_cast<char>(static_cast<int>(random.uniform(0, 256))); };
  protocol::Request full = step_request(2);
  auto& step = *full.mutable_step();
  step.add_commands()->mutable_walk()->set_vx(0.1);
  step.add_commands()->mutable_move_to()->set_x(1);
  step.add_commands()->mutable_posture()->set_posture("Crouch");
  step.add_commands()->mutable_action()->set_action("wave");
  auto& change = *step.add_commands()->mutable_change_joints();
  change.add_joint_names("HeadYaw");
  change.add_joint_position(0.1);
  for (int i = 0; i < 25; ++i) step.mutable_joint_targets()->add_position(0.1);
  const std::string whole = full.SerializeAsString();
  int num_states = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = whole;
    if (i % 3 == 0) {
      bytes.assign(static_cast<size_t>(random.uniform(0, 60)), ' ');
      for (char& letter : bytes) letter = byte();
    } else {
      const int num_changes = 1 + i % 4;
      for (int j = 0; j < num_changes; ++j) {
        bytes[static_cast<size_t>(random.uniform(0, static_cast<double>(bytes.size())))] = byte();
      }
      if (i % 5 == 0) bytes.resize(static_cast<size_t>(random.uniform(0, 200)));
    }
    protocol::Response response;
    ASSERT_TRUE(response.ParseFromString(core.handle(shortened(bytes)))) << i;
    ASSERT_NE(response.response_case(), protocol::Response::RESPONSE_NOT_SET) << i;
    if (response.has_state()) {
      ++num_states;
      for (const double value : response.state().joint_position()) {
        ASSERT_TRUE(std::isfinite(value)) << i;
      }
    }
  }
  EXPECT_GT(num_states, 100);
}

}  // namespace
}  // namespace nao::simulation_server
