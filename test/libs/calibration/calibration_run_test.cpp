#include "calibration/calibration_run.h"

#include <gtest/gtest.h>

#include "kinematics/kinematics.h"
#include "kinematics/support_polygon.h"
#include "test/daemons/motion/nao_model.h"

namespace nao {
namespace {

using motion::nao_model;
using motion::nao_motor;

StandingSample any_sample() {
  StandingSample sample;
  sample.position = nao_model().ready_posture().position;
  sample.accelerometer = {0, 0, 9.81};
  sample.foot_force.assign(8, 6.5);
  return sample;
}

TEST(CalibrationRun, StandsInElevenPosesInEveryDirection) {
  CalibrationRun run(nao_model(), 4);
  int num_turns = 0;
  for (int i = 0; i < 10000 && !run.is_done(); ++i) {
    if (const auto command = run.next_command()) {
      EXPECT_FALSE(run.next_command()) << "one command at a time";
      num_turns += std::holds_alternative<MoveToCommand>(*command) ? 1 : 0;
      run.end_command("");
    }
    run.measure(any_sample(), 0.05);
  }
  ASSERT_TRUE(run.is_done());
  EXPECT_EQ(run.fault(), "");
  EXPECT_EQ(num_turns, 3);
  EXPECT_EQ(run.estimator().num_samples(), 44);
}

TEST(CalibrationRun, TheWeightStaysTwoCentimetersWithinTheSolesInAllPoses) {
  CalibrationRun run(nao_model(), 1);
  Kinematics kinematics(nao_model());
  while (!run.is_done()) {
    const auto command = run.next_command();
    if (command && std::holds_alternative<JointChangeCommand>(*command)) {
      const auto& change = std::get<JointChangeCommand>(*command);
      std::vector<double> position = nao_model().ready_posture().position;
      for (size_t i = 0; i < change.joint_names.size(); ++i) {
        position[nao_motor(change.joint_names[i].c_str())] = change.joint_position[i];
      }
      kinematics.update(position);
      const Eigen::Isometry3d from_torso = kinematics.left_sole().inverse();
      std::vector<Eigen::Vector2d> corners;
      for (const LegDescription& leg : nao_model().legs()) {
        const Eigen::Isometry3d sole = from_torso * kinematics.link_pose(leg.sole);
        EXPECT_GT(sole.linear()(2, 2), 0.9999);
        EXPECT_NEAR(sole.translation().z(), 0, 1e-3);
        for (const Eigen::Vector2d& corner : leg.outline) {
          corners.push_back((sole * Eigen::Vector3d(corner.x(), corner.y(), 0)).head<2>());
        }
      }
      const Eigen::Vector3d com = from_torso * kinematics.center_of_mass();
      EXPECT_GT(margin_in_polygon(convex_hull(corners), com.head<2>()), 0.02);
    }
    run.end_command("");
    run.measure(any_sample(), 0.5);
  }
}

TEST(CalibrationRun, EndsWithAReasonAfterSeveralFaults) {
  CalibrationRun run(nao_model(), 4);
  for (int i = 0; i < 10 && !run.is_done(); ++i) {
    run.next_command();
    run.end_command("the robot fell");
  }
  EXPECT_TRUE(run.is_done());
  EXPECT_EQ(run.fault(), "the robot fell");
}

}  // namespace
}  // namespace nao
