#include "daemons/motion/generators/kick_pose.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Time constant, s, with which the torso compensates the leg's mass without following its every
// swing.
constexpr double kComTimeConstant = 0.05;
// Bound of the torso's heading in S, rad; the greatest in 20 kicks by nao-trial kick was 0.19.
constexpr double kMaxTorsoHeading = 0.35;
// Least slope of f for a step of Newton's method; it is 2.8 while a NAO stands.
constexpr double kMinSlope = 1;

Matrix3d about_z(double angle) {
  return AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

KickPose::KickPose(const RobotModel& model, bool is_left) : is_left_(is_left), legs_(model) {}

KickReference KickPose::start(const Kinematics& kinematics) {
  const Isometry3d& left = kinematics.left_sole();
  const Isometry3d& right = kinematics.right_sole();
  const Isometry3d torso_in_sole = (is_left_ ? right : left).inverse();
  // The torso's frame at the start defines S: heading 0, origin in the support sole.
  support_heading_ = -Pose2::from(torso_in_sole).heading;
  start_torso_ = about_z(support_heading_) * torso_in_sole;
  heading_ = exact_heading_ = impact_heading_ = 0;
  com_in_torso_ = kinematics.center_of_mass();
  const Vector3d com = start_torso_ * com_in_torso_;
  com_height_ = com.z();
  const Isometry3d foot = start_torso_ * (is_left_ ? left : right);
  return {com.head<2>(), foot.translation(), Pose2::from(foot).heading, 0};
}

void KickPose::turn_torso(const KickReference& now, const KickReference& impact) {
  exact_heading_ = find_torso_heading(now, exact_heading_);
  // On the ground the heading that the feet need now; in the air the heading that they need at the
  // impact, so that the torso does not turn back and forth within the strike.
  impact_heading_ = find_torso_heading(impact, impact_heading_);
  const double airborne = airborne_fraction(now.foot.z());
  heading_ = exact_heading_ + airborne * (impact_heading_ - exact_heading_);
}

Isometry3d KickPose::torso_in_support(const KickReference& reference, double heading) const {
  Isometry3d torso = start_torso_;
  torso.linear() = about_z(heading) * torso.linear();
  // The torso keeps the height and the inclination of the start; its horizontal place puts the CoM
  // where the reference has it.
  const Vector3d com = torso.linear() * com_in_torso_;
  torso.translation().head<2>() = reference.com - com.head<2>();
  return torso;
}

std::array<Isometry3d, 2> KickPose::soles_in_torso(const KickReference& reference,
                                                   double heading) const {
  const Isometry3d support_in_torso = torso_in_support(reference, heading).inverse();
  Isometry3d foot = Isometry3d::Identity();
  foot.translation() = reference.foot;
  foot.linear() = about_z(reference.foot_heading) *
                  AngleAxisd(reference.foot_pitch, Vector3d::UnitY()).toRotationMatrix();
  const Isometry3d kicking = support_in_torso * foot;
  const Isometry3d support = support_in_torso * Isometry3d(about_z(support_heading_));
  return is_left_ ? std::array{kicking, support} : std::array{support, kicking};
}

double KickPose::find_torso_heading(const KickReference& reference, double guess) const {
  // f: difference of the angles that both legs ask for from their shared hip motor, rad. At its
  // zero both soles have their exact pose.
  const auto difference = [&](double heading) {
    const auto [left, right] = soles_in_torso(reference, heading);
    return legs_.solve(Leg::kLeft, left).angles[0] - legs_.solve(Leg::kRight, right).angles[0];
  };
  // Two steps from the last solution leave an error far below a servo's resolution.
  constexpr int kNumSteps = 2;
  constexpr double kProbe = 0.01;  // rad, for the slope
  double heading = guess;
  for (int i = 0; i < kNumSteps; ++i) {
    const double here = difference(heading);
    const double slope = (difference(heading + kProbe) - here) / kProbe;
    if (std::abs(slope) < kMinSlope) break;
    heading = std::clamp(heading - here / slope, -kMaxTorsoHeading, kMaxTorsoHeading);
  }
  return heading;
}

void KickPose::write_legs(const KickReference& reference, std::vector<double>& position) const {
  const auto [left, right] = soles_in_torso(reference, heading_);
  // The support foot's heading is exact: its sole may not turn on the ground.
  const LegsSolution solution = legs_.solve_both(left, right, is_left_ ? 0.0 : 1.0);
  legs_.write(Leg::kLeft, solution.left, position);
  legs_.write(Leg::kRight, solution.right, position);
}

void KickPose::update_com(const Vector3d& com_in_torso, double dt) {
  com_in_torso_ += std::min(1.0, dt / kComTimeConstant) * (com_in_torso - com_in_torso_);
}

}  // namespace nao::motion
