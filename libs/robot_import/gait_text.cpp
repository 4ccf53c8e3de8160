#include "robot_import/gait_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <map>
#include <sstream>

#include "common/constants.h"
#include "common/error.h"
#include "common/yaml_entry.h"
#include "gait_texts.h"
#include "kinematics/leg_kinematics.h"

namespace nao {
namespace {

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

  /** The scales of first_gait.yaml. */
  std::map<std::string, double> units() const {
    const double time = std::sqrt(leg / kGravity);
    return {{"leg", leg},
            {"per_leg", 1 / leg},
            {"time", time},
            {"rate", 1 / time},
            {"velocity", leg / time},
            {"per_velocity", time / leg},
            {"foot_distance", foot_distance},
            {"sole_width", sole.sizes().y()},
            {"toe", sole.max().x()},
            {"heel", -sole.min().x()},
            {"hip_height", hip_height},
            {"least_distance", least_distance}};
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
    const auto units = sizes.units();
    const auto gait =
        YamlEntry::parse<ConfigError>(std::string(kGaitTexts.at("first_gait")), "first_gait.yaml");
    for (const auto& [group, rows] : gait.entries()) {
      text << "\n# " << rows.at("about").text() << "\n" << group << ":\n";
      for (const auto& [name, row] : rows.entries()) {
        if (name == "about") continue;
        const double unit = (row.has("scale") ? units.at(row.at("scale").text()) : 1) *
                            factor_of(factors, group, name);
        const double value = unit * row.at("value").number() * ankle_factor(sizes, name);
        const auto range = row.at("range").numbers(2);
        text << "  " << name << ": {value: " << value << ", range: [" << unit * range[0] << ", "
             << unit * range[1] << "]}";
        if (row.has("about")) text << "  # " << row.at("about").text();
        text << "\n";
      }
    }
  } catch (const ModelError&) {
    return "";
  }
  return text.str();
}

}  // namespace nao
