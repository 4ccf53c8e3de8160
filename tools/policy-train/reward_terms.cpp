#include "tools/policy-train/reward_terms.h"

#include <algorithm>
#include <cmath>

#include "kinematics/pose2.h"

namespace nao::policy_train {
namespace {

// Square of the error of velocity, m/s, or turn, rad/s, at which its reward has fallen to 1/e: as
// in legged_gym.
constexpr double kSquaredError = 0.25;
// The same of the mean velocity. Chosen: 0.1 m/s is a visible error.
constexpr double kSquaredMeanError = 0.02;
// m a turn counts for.
constexpr double kTurnLength = 0.5;
// Load of a foot that carries, as a fraction of the weight. Chosen: above the sensors' noise.
constexpr double kCarries = 0.05;
// Half of the time for which a foot swings, cycles: as in Booster Gym.
constexpr double kHalfSwing = 0.2;
// Least height of the torso of a robot that stands, as a fraction of the start's, and cosine of its
// greatest tilt. Chosen: lower than any stand, higher than kneeling.
constexpr double kStandingHeight = 0.85;
constexpr double kStandingUp = 0.9;
// Mean square of the joints' speeds at which the reward for standing has fallen to 1/e, (rad/s)^2.
// Chosen: a NAO that stood without it shook at 4 rad/s.
constexpr double kSquaredSpeed = 8;

double square(double value) {
  return value * value;
}

/** Yaw of a sole against the torso, rad. */
double yaw_to(const Eigen::Isometry3d& torso, const Eigen::Isometry3d& sole) {
  return wrapped(heading_of(sole.linear()) - heading_of(torso.linear()));
}

}  // namespace

const std::array<const char*, kNumRewardTerms>& reward_term_names() {
  static const std::array<const char*, kNumRewardTerms> names = {"velocity_tracking",
                                                                 "turn_tracking",
                                                                 "mean_velocity",
                                                                 "tilt",
                                                                 "height",
                                                                 "vertical_speed",
                                                                 "tilt_rate",
                                                                 "torque",
                                                                 "joint_speed",
                                                                 "joint_acceleration",
                                                                 "action_rate",
                                                                 "range",
                                                                 "lateral_posture",
                                                                 "posture",
                                                                 "rest_posture",
                                                                 "gait",
                                                                 "clearance",
                                                                 "slip",
                                                                 "sole_angle",
                                                                 "foot_distance",
                                                                 "fallen",
                                                                 "alive",
                                                                 "standing",
                                                                 "assist"};
  return names;
}

bool is_at_rest(const PolicyManifest& manifest, const Eigen::Vector3d& command) {
  return command.isZero(0) && manifest.phase_at_rest != PolicyManifest::PhaseAtRest::kContinues;
}

bool is_swing(const PolicyManifest& manifest, const Eigen::Vector3d& command, double phase,
              int foot) {
  if (is_at_rest(manifest, command) || manifest.phase_frequency == 0) return false;
  return std::abs(phase - (foot == 0 ? 0.25 : 0.75)) < kHalfSwing;
}

Eigen::Vector3d velocity_in_heading(const MotionSample& sample) {
  const Eigen::AngleAxisd heading(heading_of(sample.torso.linear()), Eigen::Vector3d::UnitZ());
  return heading.inverse() * (sample.torso.linear() * sample.linear_velocity);
}

void calc_reward_terms(const RobotModel& model, const PolicyManifest& manifest,
                       const MotionSample& start, const MotionSample& before,
                       const MotionSample& after, const Eigen::Vector3d& command, double phase,
                       bool fallen, float* terms) {
  const auto put = [terms](RewardTerm term, double value) {
    terms[static_cast<size_t>(term)] = static_cast<float>(value);
  };
  const double h = manifest.period;
  const Eigen::Vector3d velocity = velocity_in_heading(after);
  const Eigen::Vector3d turn = after.torso.linear() * after.angular_velocity;
  put(RewardTerm::kVelocityTracking,
      std::exp(-(velocity.head<2>() - command.head<2>()).squaredNorm() / kSquaredError));
  put(RewardTerm::kTurnTracking, std::exp(-square(turn.z() - command.z()) / kSquaredError));
  put(RewardTerm::kMeanVelocity,
      std::exp(
          -after.velocity_error.cwiseProduct(Eigen::Vector3d(1, 1, kTurnLength)).squaredNorm() /
          kSquaredMeanError));
  put(RewardTerm::kTilt,
      1 - square(after.torso.linear()(2, 2)) + (after.torso.linear()(2, 2) < 0 ? 1 : 0));
  const double height = start.torso.translation().z();
  put(RewardTerm::kHeight, square(after.torso.translation().z() / height - 1));
  put(RewardTerm::kVerticalSpeed, square(velocity.z()));
  put(RewardTerm::kTiltRate, after.angular_velocity.head<2>().squaredNorm());

  double torque = 0, speed = 0, square_speed = 0, acceleration = 0, rate = 0, range = 0,
         lateral = 0, posture = 0;
  for (const PolicyJoint& joint : manifest.joints) {
    const int m = joint.motor;
    const Joint& limits = model.motor_joint(m);
    torque += square(after.torque[m] / model.motor(m).peak_torque);
    speed += square(after.velocity[m] / limits.max_velocity);
    square_speed += square(after.velocity[m]);
    acceleration += square((after.velocity[m] - before.velocity[m]) / limits.max_velocity);
    rate += square(after.target[m] - before.target[m]);
    const double inside = std::clamp(after.target[m], limits.lower, limits.upper);
    range += square(after.target[m] - inside);
    const double angle = square(after.position[m] - joint.default_angle);
    posture += angle;
    if (model.symmetry().mirrors[static_cast<size_t>(m)].sign < 0) lateral += angle;
  }
  const double count = std::max(1, manifest.num_actions());
  put(RewardTerm::kTorque, torque / count);
  put(RewardTerm::kJointSpeed, speed / count);
  put(RewardTerm::kJointAcceleration, acceleration / count);
  put(RewardTerm::kActionRate, rate / count);
  put(RewardTerm::kRange, range / count);
  put(RewardTerm::kLateralPosture, lateral / count);
  put(RewardTerm::kPosture, posture / count);
  const bool stands = after.torso.linear()(2, 2) > kStandingUp &&
                      after.torso.translation().z() > kStandingHeight * height;
  const bool rests =
      manifest.kind == PolicyManifest::Kind::kGetUp ? stands : is_at_rest(manifest, command);
  put(RewardTerm::kRestPosture, rests ? posture / count : 0);

  double gait = 0, clearance = 0, slip = 0, angle = 0;
  for (size_t foot = 0; foot < 2; ++foot) {
    const Eigen::Isometry3d& sole = after.soles[foot];
    const bool carries = after.load[foot] > kCarries;
    const bool swings = is_swing(manifest, command, phase, static_cast<int>(foot));
    gait += carries != swings ? 1 : 0;
    const double rise = (sole.translation().z() - start.soles[foot].translation().z()) / height;
    if (swings) clearance += std::clamp(rise, 0.0, kClearance);
    const Eigen::Vector3d moved = sole.translation() - before.soles[foot].translation();
    if (carries) slip += moved.head<2>().squaredNorm() / square(h);
    angle += 1 - square(sole.linear()(2, 2)) + square(yaw_to(after.torso, sole));
  }
  put(RewardTerm::kGait, gait);
  put(RewardTerm::kClearance, clearance);
  put(RewardTerm::kSlip, slip);
  put(RewardTerm::kSoleAngle, angle);
  const auto side_distance = [](const MotionSample& sample) {
    const Eigen::Vector3d apart = sample.soles[0].translation() - sample.soles[1].translation();
    const Eigen::AngleAxisd back(-heading_of(sample.torso.linear()), Eigen::Vector3d::UnitZ());
    return (back * apart).y();
  };
  put(RewardTerm::kFootDistance,
      square(std::max(0.0, side_distance(start) - side_distance(after))));
  put(RewardTerm::kFallen, fallen ? 1 : 0);
  put(RewardTerm::kAlive, fallen ? 0 : 1);
  put(RewardTerm::kStanding, stands ? std::exp(-square_speed / count / kSquaredSpeed) : 0);
  put(RewardTerm::kAssist, after.assist);
}

}  // namespace nao::policy_train
