#include "daemons/robot/robot_core.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/random.h"
#include "test/daemons/robot/lola_nao.h"

namespace nao::robot {
namespace {

/** An extreme or invalid number. */
double hostile(Random& random) {
  switch (static_cast<int>(random.uniform() * 8)) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return std::numeric_limits<double>::infinity();
    case 2:
      return -1e300;
    default:
      return random.uniform(-4, 4);
  }
}

TEST(RobotCore, NoJointIsEverCommandedFasterThanItsMotorTurns) {
  const RobotModel& model = nao_model();
  for (const uint64_t seed : {1, 2, 3, 4, 5}) {
    Random random(seed);
    RobotCore core(model, nao_map(), true);
    LolaState frame = frame_of("Stand", seed % 2 == 0 ? 1 : 0);
    Targets command;
    command.position.assign(25, 0);
    command.stiffness.assign(25, 1);
    std::vector<double> last;
    int num_driven = 0;
    for (int i = 0; i < 10000; ++i) {
      // Calm stretches, in which it becomes stiff, and wild ones.
      const bool is_calm = i % 1000 < 600;
      if (!is_calm && random.uniform() < 0.01) {
        frame.angles = {static_cast<float>(hostile(random)), static_cast<float>(hostile(random))};
      }
      if (is_calm) frame.angles = {0, 0};
      if (!is_calm && random.uniform() < 0.05) frame.touch[0] = 1 - frame.touch[0];
      for (double& position : command.position) position = hostile(random);
      for (double& stiffness : command.stiffness) stiffness = random.uniform();
      for (float& position : frame.position) {
        if (random.uniform() < 0.1) position = static_cast<float>(hostile(random));
      }
      core.take_frame(frame, 1 + static_cast<int>(random.uniform() * 3));
      const bool has_command = is_calm || random.uniform() < 0.8;
      if (!last.empty()) last = core.targets().position;
      core.step({has_command ? &command : nullptr, false, false});
      num_driven += core.safety().phase() == Phase::kDriven ? 1 : 0;
      for (int motor = 0; motor < model.num_motors(); ++motor) {
        const double target = core.targets().position[static_cast<size_t>(motor)];
        ASSERT_TRUE(std::isfinite(target));
        const double stiffness = core.targets().stiffness[static_cast<size_t>(motor)];
        ASSERT_TRUE(stiffness >= 0 && stiffness <= 1);
        if (last.empty()) continue;
        const double step = model.motor_joint(motor).max_velocity * 0.012;
        ASSERT_LE(std::abs(target - last[static_cast<size_t>(motor)]), step * (1 + 1e-9))
            << model.motor_names()[static_cast<size_t>(motor)] << " at frame " << i;
      }
      last = core.targets().position;
    }
    EXPECT_GT(num_driven, 300) << "the test must reach what it tests";
  }
}

TEST(RobotCore, EyesShowTheStateAndFaultsWin) {
  RobotCore core(nao_model(), nao_map(), false);
  LolaState frame = frame_of("Stand", 0);
  Targets command;
  command.position = nao_model().find_posture("Stand")->position;
  command.stiffness.assign(25, 1);
  const auto eyes = [&](bool has_controller, bool has_driver) {
    core.take_frame(frame, 1);
    return light_color(core.step({has_controller ? &command : nullptr, has_driver, false}), "LEye");
  };
  const auto near = [](const std::array<double, 3>& color) {
    return testing::Pointwise(testing::DoubleNear(1e-6), color);
  };
  EXPECT_THAT(eyes(false, false), near(eye_color(EyeState::kNoClient)));
  EXPECT_THAT(eyes(true, false), near(eye_color(EyeState::kReady)));
  EXPECT_THAT(eyes(true, true), near(eye_color(EyeState::kDriver)));
  core.lights().set({{"left-eye"}, {{1, 0, 1}}, 0.05});
  EXPECT_THAT(eyes(true, true), near({1, 0, 1}));
  for (int i = 0; i < 5; ++i) eyes(true, true);
  EXPECT_THAT(eyes(true, true), near(eye_color(EyeState::kDriver)));
  core.lights().set({{"left-eye"}, {{1, 0, 1}}, 0});
  frame.battery[0] = 0;
  for (int i = 0; i < 50; ++i) eyes(true, true);
  EXPECT_THAT(eyes(true, true), near(eye_color(EyeState::kFault)));
}

}  // namespace
}  // namespace nao::robot
