#include "daemons/motion/generators/fall_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace nao::motion {
namespace {

// Fraction of the peak torque during a fall. Chosen: the gears of stiff joints take the whole
// impact, limp arms do not stay between body and ground.
constexpr double kStiffness = 0.3;
// Least and greatest duration of a fall, s: a fall from standing takes about the least one.
constexpr double kMinDuration = 0.6;
constexpr double kMaxDuration = 3.0;
// Angular velocity of the torso below which it lies still, rad/s, and for how long it must be, s.
constexpr double kStillVelocity = 0.3;
constexpr double kStillTime = 0.1;
// Time over which the direction of up is extrapolated to find the direction of the fall, s. Chosen:
// about the time from the prediction of a fall to the impact.
constexpr double kPredictionTime = 0.3;

struct JointAngle {
  /** Without the side: "HipPitch". */
  std::string_view joint;
  /** Of the left side, rad. */
  double angle;
};

// Bent knees lower the center of mass and with it the energy of the impact; the head turns away
// from the ground; the arms are between ground and body. Angles found in simulated falls.
constexpr auto kForward = std::to_array<JointAngle>({{"HeadPitch", -0.6},
                                                     {"ShoulderPitch", 0.3},
                                                     {"ShoulderRoll", 0.3},
                                                     {"ElbowRoll", -0.6},
                                                     {"HipPitch", -0.3},
                                                     {"KneePitch", 0.8},
                                                     {"AnklePitch", -0.3}});
constexpr auto kBackward = std::to_array<JointAngle>({{"HeadPitch", 0.4},
                                                      {"ShoulderPitch", 1.2},
                                                      {"ShoulderRoll", 0.3},
                                                      {"ElbowRoll", -0.6},
                                                      {"HipPitch", -0.9},
                                                      {"KneePitch", 0.9},
                                                      {"AnklePitch", 0}});
constexpr auto kSideways = std::to_array<JointAngle>({{"HeadPitch", 0},
                                                      {"ShoulderPitch", 1.4},
                                                      {"ShoulderRoll", 0.2},
                                                      {"ElbowRoll", -0.6},
                                                      {"HipPitch", -0.5},
                                                      {"KneePitch", 0.9},
                                                      {"AnklePitch", -0.4}});

/** Writes a pose for the head and both sides; rolls of the right side change their sign. */
template <size_t N>
void write_pose(const RobotModel& model, const std::array<JointAngle, N>& pose,
                std::vector<double>& position) {
  const auto set = [&](const std::string& name, double angle) {
    const int motor = model.find_motor(name);
    if (motor >= 0) position[motor] = angle;
  };
  for (const auto& [name, angle] : pose) {
    const std::string joint(name);
    set(joint, angle);
    set("L" + joint, angle);
    set("R" + joint, joint.ends_with("Roll") ? -angle : angle);
  }
}

}  // namespace

void FallMotion::start(const MotionContext& context, const JointTargets& targets) {
  pose_ = targets.position;
  time_ = 0;
  time_still_ = 0;
  // Up in the torso frame changes by -w x up: a fall to the front makes its x component negative.
  const Eigen::Vector3d up = context.state.torso_in_odometry.linear().row(2);
  const Eigen::Vector3d later =
      up - kPredictionTime * context.state.angular_velocity_torso.cross(up);
  if (std::abs(later.y()) > std::abs(later.x())) {
    write_pose(context.model, kSideways, pose_);
  } else if (later.x() < 0) {
    write_pose(context.model, kForward, pose_);
  } else {
    write_pose(context.model, kBackward, pose_);
  }
}

MotionGenerator::Phase FallMotion::step(const MotionContext& context, JointTargets& targets) {
  time_ += context.dt;
  // At the motors' greatest speed: the core limits the targets.
  targets.position = pose_;
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), kStiffness);
  const bool is_still = context.state.angular_velocity_torso.norm() < kStillVelocity;
  time_still_ = is_still ? time_still_ + context.dt : 0;
  const bool lies_still = time_ >= kMinDuration && time_still_ >= kStillTime;
  if (!lies_still && time_ < kMaxDuration) return Phase::kRunning;
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), 1.0);
  return Phase::kDone;
}

}  // namespace nao::motion
