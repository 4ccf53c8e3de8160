#include "daemons/motion/generators/fall_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nao::motion {
namespace {

// Share of the torque while falling: gears break at full stiffness, arms fold uselessly at none.
constexpr double kStiffness = 0.3;
constexpr double kShortest = 0.6;   // s; a fall from standing takes about that long
constexpr double kLongest = 3.0;    // s
constexpr double kStillTime = 0.1;  // s
constexpr double kStill = 0.3;      // rad/s

using Pose = std::initializer_list<std::pair<const char*, double>>;

// Knees give way, which lowers the fall; the head turns away from the floor, and the arms go
// between it and the body. Angles of the left side, rad.
constexpr std::pair<const char*, double> kForward[] = {
    {"HeadPitch", -0.6}, {"ShoulderPitch", 0.3}, {"ShoulderRoll", 0.3}, {"ElbowRoll", -0.6},
    {"HipPitch", -0.3},  {"KneePitch", 0.8},     {"AnklePitch", -0.3}};
constexpr std::pair<const char*, double> kBackward[] = {
    {"HeadPitch", 0.4}, {"ShoulderPitch", 1.2}, {"ShoulderRoll", 0.3}, {"ElbowRoll", -0.6},
    {"HipPitch", -0.9}, {"KneePitch", 0.9},     {"AnklePitch", 0}};
constexpr std::pair<const char*, double> kSideways[] = {
    {"HeadPitch", 0},   {"ShoulderPitch", 1.4}, {"ShoulderRoll", 0.2}, {"ElbowRoll", -0.6},
    {"HipPitch", -0.5}, {"KneePitch", 0.9},     {"AnklePitch", -0.4}};

template <size_t N>
void write_pose(const RobotModel& model, const std::pair<const char*, double> (&pose)[N],
                std::vector<double>& position) {
  const auto set = [&](const std::string& name, double angle) {
    const int motor = model.find_motor(name);
    if (motor >= 0) position[motor] = angle;
  };
  for (const auto& [name, angle] : pose) {
    const std::string joint = name;
    const bool changes_sign = joint.size() > 4 && joint.compare(joint.size() - 4, 4, "Roll") == 0;
    set(joint, angle);
    set("L" + joint, angle);
    set("R" + joint, changes_sign ? -angle : angle);
  }
}

}  // namespace

void FallMotion::start(const MotionContext& context, const JointTargets& targets) {
  pose_ = targets.position;
  time_ = 0;
  time_still_ = 0;
  // It falls to where up turns away from, and faster so by its angular velocity.
  const Eigen::Vector3d up = context.state.torso_in_odometry.linear().row(2);
  constexpr double kAhead = 0.3;  // s
  const Eigen::Vector3d later = up - kAhead * context.state.angular_velocity_torso.cross(up);
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
  // As fast as the motors turn; the core limits it.
  targets.position = pose_;
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), kStiffness);
  const bool is_still = context.state.angular_velocity_torso.norm() < kStill;
  time_still_ = is_still ? time_still_ + context.dt : 0;
  const bool lies_still = time_ >= kShortest && time_still_ >= kStillTime;
  if (!lies_still && time_ < kLongest) return Phase::kRunning;
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), 1.0);
  return Phase::kDone;
}

}  // namespace nao::motion
