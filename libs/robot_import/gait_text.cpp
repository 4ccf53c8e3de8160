#include "robot_import/gait_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>

#include "common/constants.h"
#include "common/error.h"
#include "kinematics/leg_kinematics.h"

namespace nao {
namespace {

/** Scale of which a parameter is a multiple. */
enum class Scale {
  kOne,
  /** Length of the leg, hip to ankle, m. */
  kLength,
  /** sqrt(l / g), s, and its inverse. */
  kTime,
  kRate,
  /** sqrt(g l), m/s. */
  kVelocity,
  /** sqrt(l / g) / l, s/m: rad per m/s. */
  kPerVelocity,
  /** 1 / l, 1/m. */
  kPerLength,
  /** Distance of the soles at the angles 0, width of a sole, its length ahead of and behind the
   * point below the ankle, m. */
  kFootDistance,
  kSoleWidth,
  kToe,
  kHeel,
  /** Height of the hips above the ground in the walk, m. */
  kHipHeight,
  /** Least distance of the soles, m. */
  kLeastDistance,
};

struct Row {
  const char* name;
  Scale scale;
  double value;
  double lower;
  double upper;
  /** Keys, as in data/robots/nao/gait.yaml. */
  const char* comment;
};

// Multiples of the scales. Found: those of data/robots/nao/gait.yaml, rounded, with a higher swing
// and a greater load at touchdown, which joint torques measure less accurately than force sensors,
// and the feet as far apart as in the ready posture, in which a walk ends. Durations of the control
// loop (lag, lead) do not scale.
constexpr std::array kRows = {
    Row{"timing", {}, 0, 0, 0, "Durations, s."},
    Row{"step_duration", Scale::kTime, 1.7, 1.2, 3.5, "duration of one step"},
    Row{"min_step_duration", Scale::kTime, 1.4, 1, 2.1, "bounds when feedback changes it"},
    Row{"max_step_duration", Scale::kTime, 2.55, 2.1, 4.2, ""},
    Row{"double_support_duration", Scale::kTime, 0.08, 0, 1, "weight transfer between the feet"},
    Row{"start_duration", Scale::kTime, 0.83, 0.35, 2.8, "weight transfer to the first support"},
    Row{"stop_duration", Scale::kTime, 0.35, 0.14, 10, "time on both feet after the last step"},
    Row{"raise_duration", Scale::kTime, 2.8, 1.4, 7, "rise from the walking stance to the stand"},
    Row{"late_duration", Scale::kTime, 0.08, 0, 1.4, "wait for a late touchdown"},
    Row{"stop_horizon", Scale::kTime, 1.4, 0.7, 3.5, "time to bring the DCM to rest"},
    Row{"stance", {}, 0, 0, 0, "Pose of torso and feet: m, rad, s."},
    Row{"hip_height", Scale::kHipHeight, 1, 0.9, 1.04, "height of the hips"},
    Row{"torso_pitch", Scale::kOne, 0.03, -0.05, 0.2, "forward positive"},
    Row{"foot_separation", Scale::kFootDistance, 1, 0.75, 1.2, "distance of the soles' origins"},
    Row{"turn_center", Scale::kLength, 0.12, -0.1, 0.25, "body frame's lead over the soles"},
    Row{"zmp_forward", Scale::kToe, 0.08, -0.15, 0.4, "nominal zero moment point of a sole"},
    Row{"zmp_inward", Scale::kSoleWidth, 0.1, -0.2, 0.4, ""},
    Row{"com_time_constant", Scale::kTime, 0.92, 0, 3.5, "low-pass of the swing leg's effect"},
    Row{"swing", {}, 0, 0, 0, "Trajectory of the swing foot: m, fractions, rad s/m, m/s."},
    Row{"height", Scale::kLength, 0.08, 0.03, 0.2, "of the sole at mid-swing"},
    Row{"arrival_fraction", Scale::kOne, 0.96, 0.6, 1, "until the foot is above its foothold"},
    Row{"toe_pitch_gain", Scale::kPerVelocity, 0.09, 0, 0.28, "toe-up pitch per forward velocity"},
    Row{"touchdown_load_ratio", Scale::kOne, 0.35, 0.03, 0.6,
        "fraction of the weight at touchdown"},
    Row{"late_speed", Scale::kVelocity, 0.057, 0, 0.2, "lowering after the planned touchdown"},
    Row{"late_depth", Scale::kLength, 0.05, 0, 0.25, ""},
    Row{"step_limits", {}, 0, 0, 0, "Bounds of one footstep: m, rad."},
    Row{"max_forward", Scale::kLength, 0.54, 0.15, 0.8, ""},
    Row{"max_backward", Scale::kLength, 0.44, 0.15, 0.8, ""},
    Row{"max_outward", Scale::kLength, 0.45, 0.15, 0.6, "in addition to foot_separation"},
    Row{"min_foot_separation", Scale::kLeastDistance, 1, 0.9, 1.1, "with parallel feet"},
    Row{"max_turn_outward", Scale::kOne, 0.6, 0.2, 1, ""},
    Row{"max_turn_inward", Scale::kOne, 0.2, 0, 0.5, ""},
    Row{"turn_inward_without_spread", Scale::kOne, 0.05, 0, 0.3, ""},
    Row{"square_distance", Scale::kLength, 0.1, 0.025, 0.25, "limit for feet side by side"},
    Row{"velocity", {}, 0, 0, 0, "Velocity of the steps: m/s, rad/s, 1/s, m, s."},
    Row{"max_change_vx", Scale::kVelocity, 0.09, 0.007, 0.15, "change from one step to the next"},
    Row{"max_change_vy", Scale::kVelocity, 0.06, 0.007, 0.15, ""},
    Row{"max_change_wz", Scale::kRate, 0.11, 0.007, 0.3, ""},
    Row{"envelope_exponent", Scale::kOne, 1.5, 1, 4, ""},
    Row{"path_gain", Scale::kRate, 0.07, 0, 0.42, "gain from path error to velocity"},
    Row{"max_path_offset", Scale::kLength, 0.3, 0.05, 1, ""},
    Row{"full_speed_lag", Scale::kTime, 0.28, 0.07, 0.7, "lags of the control loop"},
    Row{"slow_speed_lag", Scale::kTime, 0.33, 0.07, 1.4, ""},
    Row{"slow_speed", Scale::kOne, 0.65, 0.2, 1, "fraction of the limits at slow_speed_lag"},
    Row{"slow_turning", Scale::kOne, 0.65, 0.2, 1, "the same for the greatest turn"},
    Row{"slow_envelope_exponent", Scale::kOne, 1, 1, 4, "envelope_exponent at slow_speed_lag"},
    Row{"dead_sensor_speed", Scale::kOne, 0.7, 0.2, 1,
        "fraction of the limits with a dead foot sensor"},
    Row{"zmp", {}, 0, 0, 0, "Control law of the zero moment point: 1, m."},
    Row{"gain", Scale::kOne, 1.04, 0, 1.5, ""},
    Row{"reach_forward", Scale::kToe, 0.37, 0, 0.8, "distance from the nominal point"},
    Row{"reach_backward", Scale::kHeel, 0.4, 0, 0.8, ""},
    Row{"reach_sideways", Scale::kSoleWidth, 0.22, 0, 0.4, ""},
    Row{"feedback", {}, 0, 0, 0, "Feedback of the measured center of mass: s, 1/s, 1, m."},
    Row{"initial_lag", Scale::kOne, 0.03, 0, 0.1, "time from a command to its measurement"},
    Row{"com_position_gain", Scale::kRate, 0.7, 0, 5.7, ""},
    Row{"com_velocity_gain", Scale::kRate, 0.57, 0, 5.7, ""},
    Row{"footstep_gain", Scale::kOne, 0.5, 0, 1.5, ""},
    Row{"timing_gain", Scale::kOne, 0.45, 0, 1.2, ""},
    Row{"ankle_dcm_gain", Scale::kOne, 0.5, 0, 4, ""},
    Row{"bias_gain", Scale::kOne, 0.04, 0, 0.5, ""},
    Row{"max_bias", Scale::kToe, 0.4, 0, 0.9, ""},
    Row{"max_com_offset", Scale::kToe, 0.4, 0, 0.9, ""},
    Row{"com_offset_gain", Scale::kOne, 0.1, 0, 2, "per tick, for the measurement's bias"},
    Row{"orientation", {}, 0, 0, 0, "Feedback of the torso's motion: s, 1."},
    Row{"gyro_ankle_pitch", Scale::kTime, 0.34, -0.7, 1, ""},
    Row{"gyro_ankle_roll", Scale::kTime, 0.58, -0.7, 1, ""},
    Row{"gyro_hip_pitch", Scale::kTime, -0.03, -0.7, 0.7, ""},
    Row{"gyro_hip_roll", Scale::kTime, 0.22, -0.7, 0.7, ""},
    Row{"tilt_ankle_pitch", Scale::kOne, 0, -0.5, 0.5, ""},
    Row{"tilt_ankle_roll", Scale::kOne, 0, -0.5, 0.5, ""},
    Row{"standing",
        {},
        0,
        0,
        0,
        "Feedback of the torso's motion while the robot stands: s, rad/s, m."},
    Row{"ankle_pitch", Scale::kTime, 0, 0, 1, ""},
    Row{"hip_pitch", Scale::kTime, 0, 0, 2, ""},
    Row{"least_rate", Scale::kRate, 0.02, 0, 0.2, "rate below which only the servos hold"},
    Row{"step_margin", Scale::kLength, -0.045, -0.2, 0.2, "capture point's, below which it steps"},
    Row{"servo", {}, 0, 0, 0, "Feedforward to the position servos: s, 1."},
    Row{"lead_time", Scale::kOne, 0.002, 0, 0.04, ""},
    Row{"torque_scale", Scale::kOne, 1, 0, 1.3, ""},
    Row{"velocity_scale", Scale::kOne, 0.7, 0, 1.3, ""},
    Row{"inertia_scale", Scale::kOne, 0.8, 0, 1.3, "for the swing leg's acceleration"},
    Row{"kick", {}, 0, 0, 0, "Kick during the walk, m."},
    Row{"ball_distance", Scale::kLength, 0.84, 0.6, 1.2, ""},
    Row{"swing_reach", Scale::kLength, 0.3, 0, 0.5, ""},
    Row{"swing_lift", Scale::kLength, 0.17, 0, 0.25, ""},
    Row{"arms", {}, 0, 0, 0, "Arms, rad/m."},
    Row{"swing_gain", Scale::kPerLength, 0.37, 0, 1.6, ""},
};

// Height of the hips in the walk, fraction of that with stretched legs: bent as the NAO's; and the
// greatest at which the foot still swings. Between them the knee decides.
constexpr double kBentHeight = 0.91;
constexpr double kStretchedHeight = 0.95;
// Fraction of its greatest torque that the knee of the support leg may need. Chosen: leaves the
// rest to the steps.
constexpr double kKneeLoad = 0.6;
// Soles side by side: their widths apart, or the gap between them, m, but not farther apart than in
// the stance.
constexpr double kWidthsApart = 1.25;
constexpr double kSoleGap = 0.01;
constexpr double kOfStance = 0.9;

// Factor on footstep_gain without an ankle that rolls. Found with published robots whose ankles
// have one axis: 0 to 3 of 6 walks without it, 6 of 6 with it.
constexpr double kFootstepsAlone = 0.6;

/** Sizes of a robot, m. */
struct Sizes {
  double leg;
  double foot_distance;
  double hip_height;
  double least_distance;
  Eigen::AlignedBox2d sole;
  /** Ankles that move the zero moment point across the sole. */
  bool has_ankle_roll = true;

  double unit(Scale scale) const {
    const double time = std::sqrt(leg / kGravity);
    switch (scale) {
      case Scale::kOne:
        return 1;
      case Scale::kLength:
        return leg;
      case Scale::kTime:
        return time;
      case Scale::kRate:
        return 1 / time;
      case Scale::kVelocity:
        return leg / time;
      case Scale::kPerVelocity:
        return time / leg;
      case Scale::kPerLength:
        return 1 / leg;
      case Scale::kFootDistance:
        return foot_distance;
      case Scale::kSoleWidth:
        return sole.sizes().y();
      case Scale::kToe:
        return sole.max().x();
      case Scale::kHeel:
        return -sole.min().x();
      case Scale::kHipHeight:
        return hip_height;
      case Scale::kLeastDistance:
        return least_distance;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
};

Sizes measure(const RobotModel& model, const LegKinematics& legs, double foot_distance) {
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  const Eigen::Vector3d left = poses[model.left_sole()].translation();
  const Eigen::Vector3d right = poses[model.right_sole()].translation();
  const Eigen::Vector3d hips = 0.5 * (legs.hip(Leg::kLeft) + legs.hip(Leg::kRight));
  const double stretched = hips.z() - left.z();
  // One leg carries the robot on a knee that is l / 2 sin(acos(height / l)) ahead of the line from
  // hip to ankle (thigh and shank of l / 2).
  const int knee = legs.motors(Leg::kLeft)[legs.roles(Leg::kLeft).knee];
  const double lever = kKneeLoad * model.motor_joint(knee).max_torque /
                       (model.total_mass() * kGravity * 0.5 * legs.reach());
  const double height = std::sqrt(1 - std::min(1.0, lever * lever));
  Sizes sizes{legs.reach(),
              foot_distance * (left.y() - right.y()),
              stretched * std::clamp(height, kBentHeight, kStretchedHeight),
              0,
              {},
              legs.roles(Leg::kLeft).ankle_roll >= 0};
  for (const Eigen::Vector2d& corner : model.left_sole_outline()) sizes.sole.extend(corner);
  Eigen::AlignedBox2d right_sole;
  for (const Eigen::Vector2d& corner : model.right_sole_outline()) right_sole.extend(corner);
  const double inner_sides = right_sole.max().y() - sizes.sole.min().y();
  sizes.least_distance = std::min({kWidthsApart * sizes.sole.sizes().y(), inner_sides + kSoleGap,
                                   kOfStance * sizes.foot_distance});
  return sizes;
}

// Without that axis of the ankle the foot carries the robot below the ankle, and footsteps alone
// keep the balance in this direction. The hip's roll would tilt the torso, not move the load.
double ankle_factor(const Sizes& sizes, const std::string& name) {
  const bool is_across =
      name == "zmp_inward" || name == "reach_sideways" || name == "gyro_hip_roll";
  if (is_across && !sizes.has_ankle_roll) return 0;
  return name == "footstep_gain" && !sizes.has_ankle_roll ? kFootstepsAlone : 1;
}

double factor_of(const GaitFactors& factors, const std::string& group, const std::string& name) {
  if (group == "swing" && name == "height") return factors.swing_height;
  if (name == "hip_height") return factors.hip_height;
  const bool is_step = group == "timing" && name.find("step_duration") != std::string::npos;
  return is_step ? factors.step_duration : 1;
}

}  // namespace

std::string make_gait_text(const RobotModel& model, const GaitFactors& factors) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(4)
       << "# How the robot walks: {value, range}; m, s, rad. Scaled by the length of its legs, "
       << kUntunedGait << ":\n"
       << "# nao-walk-tuner may choose a value within its range. data/robots/nao/gait.yaml "
          "explains the "
          "parameters.\n";
  try {
    const LegKinematics legs(model);
    // A walk begins with a stand, which needs an ankle.
    if (legs.roles(Leg::kLeft).ankle_pitch < 0) return "";
    const Sizes sizes = measure(model, legs, factors.foot_distance);
    std::string group;
    for (const Row& row : kRows) {
      if (row.upper == 0) {
        group = row.name;
        text << "\n# " << row.comment << "\n" << row.name << ":\n";
        continue;
      }
      const double unit = sizes.unit(row.scale) * factor_of(factors, group, row.name);
      const double value = unit * row.value * ankle_factor(sizes, row.name);
      text << "  " << row.name << ": {value: " << value << ", range: [" << unit * row.lower << ", "
           << unit * row.upper << "]}";
      if (*row.comment != 0) text << "  # " << row.comment;
      text << "\n";
    }
  } catch (const ModelError&) {
    return "";
  }
  return text.str();
}

}  // namespace nao
