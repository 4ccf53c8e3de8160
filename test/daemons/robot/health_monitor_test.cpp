#include "daemons/robot/health_monitor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/daemons/robot/lola_nao.h"

namespace nao::robot {
namespace {

class Health : public testing::Test {
 protected:
  Health() {
    targets_.position = reader_.read(frame_, 0).position;
    targets_.stiffness.assign(targets_.position.size(), 1);
  }

  void run(int num_frames) {
    for (int i = 0; i < num_frames; ++i)
      monitor_.step(reader_.read(frame_, 0.012), targets_, 0.012);
  }

  LolaState frame_ = frame_of("Stand", 1);
  MeasurementReader reader_{nao_model(), nao_map()};
  Targets targets_;
  HealthMonitor monitor_{nao_model().num_motors()};
};

TEST_F(Health, NothingIsAtFaultOfAHealthyRobot) {
  run(1000);
  EXPECT_EQ(monitor_.fault(), Fault::kNone);
  EXPECT_THAT(monitor_.warnings(), testing::IsEmpty());
}

TEST_F(Health, WarnsOfALowBatteryAndStopsAtAnEmptyOne) {
  frame_.battery[0] = 0.2f;
  run(1000);
  EXPECT_EQ(monitor_.fault(), Fault::kNone);
  EXPECT_THAT(monitor_.warnings(), testing::ElementsAre("battery-low"));
  frame_.battery[0] = 0.09f;
  run(20);
  EXPECT_EQ(monitor_.fault(), Fault::kNone)
      << "a single wrong reading does not mean an empty battery";
  run(100);
  EXPECT_EQ(monitor_.fault(), Fault::kBatteryLow);
}

TEST_F(Health, WarnsOfHotMotorsAndStopsWhereTheRobotReducesTheirTorque) {
  const auto knee = static_cast<size_t>(nao_map().joints[10].motor);
  frame_.temperature[10] = 76;
  run(100);
  EXPECT_EQ(monitor_.fault(), Fault::kNone);
  EXPECT_THAT(monitor_.warnings(), testing::ElementsAre("joint-hot"));
  EXPECT_EQ(monitor_.motor(static_cast<int>(knee)), HealthMonitor::Motor::kHot);
  frame_.status[10] = 2;
  run(100);
  EXPECT_EQ(monitor_.fault(), Fault::kHeat);
  EXPECT_EQ(monitor_.motor(static_cast<int>(knee)), HealthMonitor::Motor::kReduced);
  frame_.status[10] = 3;
  run(1);
  EXPECT_EQ(monitor_.motor(static_cast<int>(knee)), HealthMonitor::Motor::kOff);
}

TEST_F(Health, AStiffMotorOffItsTargetWithoutCurrentIsDead) {
  const auto knee = static_cast<size_t>(nao_map().joints[10].motor);
  frame_.current[10] = 0;
  run(200);
  EXPECT_EQ(monitor_.fault(), Fault::kNone) << "at its target it needs no current";
  targets_.position[knee] += 0.05;
  run(80);
  EXPECT_EQ(monitor_.fault(), Fault::kNone);
  run(5);
  EXPECT_EQ(monitor_.fault(), Fault::kDeadMotor);
  EXPECT_THAT(monitor_.warnings(), testing::ElementsAre("joint-dead"));
  // Limp now, it stays dead until it draws current.
  targets_.stiffness[knee] = 0;
  run(100);
  EXPECT_EQ(monitor_.fault(), Fault::kDeadMotor);
  frame_.current[10] = 0.1f;
  run(1);
  EXPECT_EQ(monitor_.fault(), Fault::kNone);
}

}  // namespace
}  // namespace nao::robot
