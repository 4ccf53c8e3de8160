#include "daemons/motion/generators/kick_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;

// rad: Newton's method is exact to the last bits, the angles' limits are far.
constexpr double kTolerance = 1e-6;

const Kick& nao_kick() {
  static const Kick kick =
      Kick::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao" / "actions" / "kick.yaml");
  return kick;
}

/** A KickPose in a stand with a given HipYawPitch, and its legs after some references. */
class Stand {
 public:
  Stand(bool is_left, double hip_yaw_pitch)
      : is_left_(is_left), pose_(nao_model(), is_left), kinematics_(nao_model()) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    position_ = nao_posture("StandInit");
    position_[nao_motor("LHipYawPitch")] = hip_yaw_pitch;
    level_soles();
    stand_ = pose_.start(kinematics_);
    KickTrajectory trajectory(nao_kick(), is_left, {nan, nan}, 1);
    trajectory.start_from(stand_);
    impact_ = trajectory.impact();
  }

  const KickReference& stand() const { return stand_; }
  const KickReference& impact() const { return impact_; }
  KickPose& pose() { return pose_; }

  /** Heading of the kicking sole in S, rad, with the legs that realize a reference. */
  double kicking_heading(const KickReference& reference) {
    pose_.write_legs(reference, position_);
    kinematics_.update(position_);
    const Isometry3d& left = kinematics_.left_sole();
    const Isometry3d& right = kinematics_.right_sole();
    const Isometry3d kicking_in_support =
        is_left_ ? right.inverse() * left : left.inverse() * right;
    return pose_.support_heading() + Pose2::from(kicking_in_support).heading;
  }
  /** Position of the kicking sole in S, m. */
  Eigen::Vector3d kicking_position() const {
    const Isometry3d kicking_in_support =
        is_left_ ? kinematics_.right_sole().inverse() * kinematics_.left_sole()
                 : kinematics_.left_sole().inverse() * kinematics_.right_sole();
    return Eigen::AngleAxisd(pose_.support_heading(), Eigen::Vector3d::UnitZ()) *
           kicking_in_support.translation();
  }

 private:
  /** Both soles flat on the same ground. */
  void level_soles() {
    const LegKinematics legs(nao_model());
    kinematics_.update(position_);
    Isometry3d left = kinematics_.left_sole();
    Isometry3d right = kinematics_.right_sole();
    for (Isometry3d* sole : {&left, &right}) {
      const double heading = Pose2::from(*sole).heading;
      sole->linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      sole->translation().z() = -0.32;  // m, below the torso: knees bent
    }
    const LegsSolution solution = legs.solve_both(left, right);
    legs.write(Leg::kLeft, solution.left, position_);
    legs.write(Leg::kRight, solution.right, position_);
    kinematics_.update(position_);
  }

  bool is_left_;
  KickPose pose_;
  Kinematics kinematics_;
  std::vector<double> position_;
  KickReference stand_;
  KickReference impact_;
};

TEST(KickPose, FootPointsInTheRequestedDirectionAtTheImpact) {
  for (const bool is_left : {true, false}) {
    for (const double hip_yaw_pitch : {0.0, -0.2}) {  // feet parallel; 0.14 rad outwards each
      Stand stand(is_left, hip_yaw_pitch);
      // With the heading of the start, the shared joint turns the foot away.
      EXPECT_GT(std::abs(stand.kicking_heading(stand.impact())), 0.01);
      stand.pose().turn_torso(stand.impact(), stand.impact());
      EXPECT_NEAR(stand.kicking_heading(stand.impact()), 0, kTolerance);
      EXPECT_LT((stand.kicking_position() - stand.impact().foot).norm(), kTolerance);
    }
  }
}

TEST(KickPose, FootPointsAlongItsPathWhenTheSupportFootHasYawed) {
  for (const double yaw : {-0.1, 0.1}) {
    Stand stand(true, 0);
    const KickReference impact =
        hold_path_over_ground(stand.impact(), Pose2{Vector2d::Zero(), yaw}.inverse());
    stand.pose().turn_torso(impact, impact);
    EXPECT_NEAR(yaw + stand.kicking_heading(impact), 0, kTolerance);
  }
}

TEST(KickPose, StartsWithTheJointsThatItFinds) {
  Stand stand(true, -0.2);
  stand.pose().turn_torso(stand.stand(), stand.impact());
  EXPECT_NEAR(stand.pose().torso_heading(), 0, kTolerance);
  EXPECT_NEAR(stand.kicking_heading(stand.stand()), stand.stand().foot_heading, kTolerance);
  EXPECT_LT((stand.kicking_position() - stand.stand().foot).norm(), kTolerance);
}

TEST(KickPose, TorsoDoesNotTurnWhileTheFootIsInTheAir) {
  Stand stand(true, 0);
  KickReference drawn = stand.impact();
  drawn.foot.x() -= 0.1;
  stand.pose().turn_torso(drawn, stand.impact());
  const double before = stand.pose().torso_heading();
  stand.pose().turn_torso(stand.impact(), stand.impact());
  EXPECT_NEAR(stand.pose().torso_heading(), before, 1e-4);  // rad: Newton's method converges
}

}  // namespace
}  // namespace nao::motion
