#include "robot_import/leg_numbers.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "common/constants.h"
#include "kinematics/kinematics.h"
#include "robot_import/description_text.h"
#include "robot_import/repair_log.h"
#include "robot_import/robot_structure.h"
#include "robot_import/urdf_values.h"
#include "robot_model/child_elements.h"

namespace nao {
namespace {

// Torques of the hip's pitch joint in units of m g l, the robot's weight at the hip's height:
// published humanoids have 0.1 to 1.
constexpr double kLeastLegTorque = 0.06;
constexpr double kAssumedLegTorque = 0.3;
// Torques of a joint that carries a part of the robot above it: in units of the part's m g h, and
// of the torque that its weight has at the angles 0, of which half a motor holds without a time
// limit; and the fraction of the robot's mass from which on a part counts.
constexpr double kLeastCarrying = 0.3;
constexpr double kLeastHolding = 2;
constexpr double kAssumed = 2;
constexpr double kHeavyPart = 0.2;
// Efforts of mirror images that differ by more than this factor are a fault.
constexpr double kUnlike = 2;
// Range, rad, that a joint of the hip or ankle with a pitch axis gets where the legs have no
// stance.
constexpr double kAssumedRange = 1;

class LegNumbers {
 public:
  LegNumbers(const RobotModel& model, const std::string& file, TiXmlElement& robot)
      : model_(model), robot_(robot), log_{file, {}} {
    for (const LegDescription& leg : model.legs()) {
      for (const int joint : leg.joints) motors_.insert(model.motor_of(joint));
    }
    motors_.erase(-1);
  }

  Findings repair() {
    if (motors_.empty()) return {};
    match_efforts();
    raise_efforts();
    raise_carrying_efforts();
    const auto ready = find_ready_stance(model_);
    if (ready) {
      raise_holding_efforts(*ready);
    } else {
      widen_ranges();
    }
    return log_.findings;
  }

 private:
  TiXmlElement* limit_of(int motor) {
    for (TiXmlElement* element : child_elements(robot_, "joint")) {
      if (element->Attribute("name") == model_.motor_joint(motor).name) {
        return element->FirstChildElement("limit");
      }
    }
    return nullptr;
  }
  std::string element_of(int motor) const { return "joint " + model_.motor_joint(motor).name; }

  void match_efforts() {
    const Symmetry symmetry = find_symmetry(model_);
    for (const int motor : motors_) {
      const double own = model_.motor_joint(motor).max_torque;
      const double other = model_.motor_joint(symmetry.mirrors[motor].motor).max_torque;
      TiXmlElement* limit = limit_of(motor);
      if (limit == nullptr || other < kUnlike * own) continue;
      limit->SetAttribute("effort", to_text(other).c_str());
      log_.note(
          Finding::Severity::kRepaired, *limit, element_of(motor),
          "has an effort of " + to_text(own) + " N m, its mirror image one of " + to_text(other),
          "the greater is assumed: write the motor's into <limit effort=>");
    }
  }

  void raise_efforts() {
    const auto poses = model_.link_poses(std::vector<double>(model_.num_motors(), 0.0));
    const double floor = poses[model_.left_sole()].translation().z();
    // The hip's pitch joints.
    double strongest = 0;
    double height = 0;
    for (const LegDescription& leg : model_.legs()) {
      const std::vector<int> pitches = find_pitches(leg);
      if (pitches.empty()) return;
      const Joint& joint = model_.motor_joint(pitches.front());
      strongest = std::max(strongest, joint.max_torque);
      height = poses[joint.child_link].translation().z() - floor;
    }
    const double weight_torque = model_.total_mass() * kGravity * height;
    if (strongest >= kLeastLegTorque * weight_torque) return;
    const double factor = kAssumedLegTorque * weight_torque / strongest;
    for (const int motor : motors_) {
      const double effort = model_.motor_joint(motor).max_torque;
      TiXmlElement* limit = limit_of(motor);
      if (limit == nullptr || effort > kUnlike * strongest) continue;
      limit->SetAttribute("effort", to_text(factor * effort).c_str());
      log_.note(Finding::Severity::kRepaired, *limit, element_of(motor),
                "the efforts of the legs do not carry the robot: those of motors before their "
                "gears",
                to_text(factor * effort) + " N m instead of " + to_text(effort) +
                    " are assumed: write the joint's effort into <limit effort=>");
    }
  }

  /** Motors of a leg with a pitch axis, from the hip's to the ankle's. */
  std::vector<int> find_pitches(const LegDescription& leg) const {
    const auto poses = model_.link_poses(std::vector<double>(model_.num_motors(), 0.0));
    std::vector<int> pitches;
    for (const int index : leg.joints) {
      const Joint& joint = model_.joints()[index];
      const int motor = model_.motor_of(index);
      const double pitch = (poses[joint.child_link].linear() * joint.axis).y();
      if (motor >= 0 && std::abs(pitch) > 0.7) pitches.push_back(motor);
    }
    return pitches;
  }

  void raise_carrying_efforts() {
    const auto poses = model_.link_poses(std::vector<double>(model_.num_motors(), 0.0));
    for (int motor = 0; motor < model_.num_motors(); ++motor) {
      const Joint& joint = model_.motor_joint(motor);
      const Eigen::Isometry3d& pose = poses[joint.child_link];
      double mass = 0;
      Eigen::Vector3d moment = Eigen::Vector3d::Zero();
      for (size_t link = 0; link < poses.size(); ++link) {
        if (!model_.moves(model_.motors()[motor], static_cast<int>(link))) continue;
        const Link& part = model_.links()[link];
        mass += part.mass;
        moment += part.mass * (poses[link] * part.center_of_mass - pose.translation());
      }
      // A vertical axis carries nothing.
      const Eigen::Vector3d axis = pose.linear() * joint.axis;
      const double pendulum = kLeastCarrying * kGravity * moment.z() * axis.head<2>().norm();
      const double weight = std::abs(axis.dot(moment.cross(Eigen::Vector3d(0, 0, -kGravity))));
      const double least = std::max(pendulum, kLeastHolding * weight);
      TiXmlElement* limit = limit_of(motor);
      if (limit == nullptr || moment.z() < 0 || mass < kHeavyPart * model_.total_mass() ||
          joint.max_torque >= least) {
        continue;
      }
      limit->SetAttribute("effort", to_text(kAssumed * least).c_str());
      log_.note(
          Finding::Severity::kRepaired, *limit, element_of(motor),
          "has an effort of " + to_text(joint.max_torque) + " N m, too small for the " +
              to_text(mass) + " kg above it",
          to_text(kAssumed * least) + " N m are assumed: write the motor's into <limit effort=>");
    }
  }

  // Each sole carries half of the weight, below the center of mass.
  void raise_holding_efforts(const std::vector<double>& ready) {
    Kinematics kinematics(model_);
    kinematics.update(ready);
    const Eigen::Vector3d weight(0, 0, -kGravity);
    for (const LegDescription& leg : model_.legs()) {
      Eigen::Vector3d support = kinematics.link_pose(leg.sole).translation();
      support.x() = kinematics.center_of_mass().x();
      for (const int index : leg.joints) {
        const int motor = model_.motor_of(index);
        TiXmlElement* limit = motor < 0 ? nullptr : limit_of(motor);
        if (limit == nullptr) continue;
        const Joint& joint = model_.joints()[index];
        const Eigen::Isometry3d& pose = kinematics.link_pose(joint.child_link);
        Eigen::Vector3d moment =
            (support - pose.translation()).cross(-0.5 * model_.total_mass() * weight);
        for (size_t link = 0; link < model_.links().size(); ++link) {
          if (!model_.moves(index, static_cast<int>(link))) continue;
          const Link& part = model_.links()[link];
          const Eigen::Vector3d center =
              kinematics.link_pose(static_cast<int>(link)) * part.center_of_mass;
          moment += (center - pose.translation()).cross(part.mass * weight);
        }
        const double torque = std::abs((pose.linear() * joint.axis).dot(moment));
        const double effort = read_number(*limit, "effort", joint.max_torque);
        if (effort >= kLeastHolding * torque) continue;
        limit->SetAttribute("effort", to_text(kAssumed * kLeastHolding * torque).c_str());
        log_.note(Finding::Severity::kRepaired, *limit, element_of(motor),
                  "has an effort of " + to_text(effort) + " N m, and standing takes " +
                      to_text(torque) + ", of which a motor becomes too warm",
                  to_text(kAssumed * kLeastHolding * torque) +
                      " N m are assumed: write the motor's into <limit effort=>");
      }
    }
  }

  /** Range of a knee, or of a joint beside it: of the two mirror images the more one-sided one,
   * which says where a knee bends. */
  std::pair<double, double> range_of(int motor, const MirrorMotor& mirror) const {
    const Joint& own = model_.motor_joint(motor);
    const Joint& other = model_.motor_joint(mirror.motor);
    std::pair<double, double> mirrored(other.lower, other.upper);
    if (mirror.sign < 0) mirrored = {-other.upper, -other.lower};
    const bool is_other_sided =
        std::abs(other.lower + other.upper) > std::abs(own.lower + own.upper) + 0.01;
    return is_other_sided ? mirrored : std::pair(own.lower, own.upper);
  }

  void widen_ranges() {
    const Symmetry symmetry = find_symmetry(model_);
    for (const LegDescription& leg : model_.legs()) {
      const std::vector<int> pitches = find_pitches(leg);
      if (pitches.size() < 3) continue;
      for (const int motor : pitches) {
        const Joint& joint = model_.motor_joint(motor);
        auto range = range_of(motor, symmetry.mirrors[motor]);
        if (motor == pitches.front() || motor == pitches.back()) {
          range.first = std::min(range.first, -kAssumedRange);
          range.second = std::max(range.second, kAssumedRange);
        }
        TiXmlElement* limit = limit_of(motor);
        if (limit == nullptr || range == std::pair(joint.lower, joint.upper)) continue;
        limit->SetAttribute("lower", to_text(range.first).c_str());
        limit->SetAttribute("upper", to_text(range.second).c_str());
        log_.note(Finding::Severity::kRepaired, *limit, element_of(motor),
                  "has a range of " + to_text(joint.lower) + " to " + to_text(joint.upper) +
                      " rad, and the legs' ranges exclude a stance with level soles",
                  to_text(range.first) + " to " + to_text(range.second) +
                      " rad are assumed: write the real range into <limit lower= upper=>");
      }
    }
  }

  const RobotModel& model_;
  TiXmlElement& robot_;
  std::set<int> motors_;
  RepairLog log_;
};

}  // namespace

std::string with_plausible_legs(const std::string& text, const RobotModel& model,
                                const std::string& file, Findings& findings) {
  TiXmlDocument document;
  document.Parse(text.c_str());
  TiXmlElement* robot = document.FirstChildElement("robot");
  if (robot == nullptr) return text;
  const Findings found = LegNumbers(model, file, *robot).repair();
  if (found.empty()) return text;
  findings.insert(findings.end(), found.begin(), found.end());
  return to_text(document);
}

}  // namespace nao
