// Forces and centers of pressure of the feet are found from the joint torques that they cause.

#include "daemons/motion/estimator/ground_reaction.h"

#include <gtest/gtest.h>

#include "common/constants.h"
#include "daemons/motion/walk/servo_feedforward.h"
#include "kinematics/leg_kinematics.h"

namespace nao::motion {
namespace {

using Eigen::Vector3d;

/** A robot in its ready posture whose joints carry given loads. */
class GroundReactionTest : public testing::TestWithParam<const char*> {
 protected:
  GroundReactionTest() : kinematics_(model_) {
    kinematics_.update(model_.ready_posture().position);
  }

  /** A point of a sole, m, in the torso frame. */
  Vector3d on_sole(int side, double x, double y) const {
    const Eigen::Isometry3d& sole = side == 0 ? kinematics_.left_sole() : kinematics_.right_sole();
    return sole * Vector3d(x, y, 0);
  }
  /** Forces on the left and the right foot, each from a point towards the center of mass, as in a
   * walk whose angular momentum does not change. @param left, right  Vertical parts, N. */
  std::array<FootReaction, 2> estimate(double left, const Vector3d& left_point, double right,
                                       const Vector3d& right_point) const {
    const auto load = [&](double force, const Vector3d& point) {
      const Vector3d to_com = kinematics_.center_of_mass() - point;
      return FootLoad{force / to_com.z() * to_com, point};
    };
    const Vector3d up = Vector3d::UnitZ();
    const auto torque = ServoFeedforward(model_).calc_torques(
        kinematics_, up, {load(left, left_point), load(right, right_point)});
    return GroundReaction(model_).estimate(kinematics_, torque, up);
  }

  RobotModel model_ =
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / GetParam());
  Kinematics kinematics_;
  double weight_ = model_.total_mass() * kGravity;
};

TEST_P(GroundReactionTest, FindsTheLoadOfEachFootAndItsCenterOfPressure) {
  // The center of mass is above the center of pressure of both feet together.
  const Vector3d com = kinematics_.center_of_mass();
  const double left_y = on_sole(0, 0, 0).y();
  const double right_y = on_sole(1, 0, 0).y();
  const double share = (com.y() - right_y) / (left_y - right_y);
  const double ahead = com.x() - on_sole(0, 0, 0).x();
  const auto found =
      estimate(share * weight_, on_sole(0, ahead, 0), (1 - share) * weight_, on_sole(1, ahead, 0));
  EXPECT_NEAR(found[0].force, share * weight_, 0.01 * weight_);
  EXPECT_NEAR(found[1].force, (1 - share) * weight_, 0.01 * weight_);
  for (const FootReaction& foot : found) EXPECT_NEAR(foot.point.x(), com.x(), 0.005);
}

TEST_P(GroundReactionTest, TellsTheSwingFoot) {
  const Vector3d point = on_sole(1, 0.01, 0.01);
  const auto found = estimate(0, on_sole(0, 0, 0), weight_, point);
  EXPECT_LT(found[0].force, 0.05 * weight_);
  EXPECT_GT(found[1].force, 0.9 * weight_);
  EXPECT_NEAR((found[1].point - point).norm(), 0, 0.015);
}

TEST_P(GroundReactionTest, FindsNoForceOnLegsThatHang) {
  // With bent knees: a force on stretched legs needs no torque.
  kinematics_.update(model_.find_posture(model_.references().rest)->position);
  const auto found = estimate(0, on_sole(0, 0, 0), 0, on_sole(1, 0, 0));
  EXPECT_LT(found[0].force + found[1].force, 0.3 * weight_);
}

TEST_P(GroundReactionTest, TakesTheTorquesOfALiftedLegForItsMotion) {
  // A leg that is bent and accelerates, with torques as if the ground carried 30 % of the weight.
  const LegKinematics legs(model_);
  Eigen::Isometry3d lifted = kinematics_.right_sole();
  lifted.translation().z() += 0.1 * legs.reach();
  std::vector<double> position = model_.ready_posture().position;
  legs.write(Leg::kRight, legs.solve(Leg::kRight, lifted).angles, position);
  kinematics_.update(position);
  const auto found = estimate(0.9 * weight_, on_sole(0, 0, 0), 0.3 * weight_, on_sole(1, 0, 0));
  EXPECT_LT(found[1].force, 0.03 * weight_);
  EXPECT_GT(found[0].force, 0.8 * weight_);
}

TEST_P(GroundReactionTest, KeepsTheCenterOfPressureOnTheSole) {
  const auto found = estimate(weight_, on_sole(0, 0.3, 0), 0, on_sole(1, 0, 0));
  const Vector3d in_sole = kinematics_.left_sole().inverse() * found[0].point;
  double toe = 0;
  for (const Eigen::Vector2d& corner : model_.left_sole_outline()) toe = std::max(toe, corner.x());
  EXPECT_NEAR(in_sole.x(), toe, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Robots, GroundReactionTest, testing::Values("nao", "t1", "g1"));

}  // namespace
}  // namespace nao::motion
