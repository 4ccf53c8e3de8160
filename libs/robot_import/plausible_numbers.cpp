#include "robot_import/plausible_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include "common/constants.h"
#include "robot_import/repair_log.h"
#include "robot_import/urdf_values.h"
#include "robot_model/child_elements.h"

namespace nao {
namespace {

// Torques in units of m g l, the robot's weight at the length of its leg; published humanoids have
// 0.2 to 1 at the knee. Above the greatest a number is a placeholder; below the least the knees do
// not carry the robot, and one number for all joints was not measured.
constexpr double kGreatestTorque = 2;
constexpr double kLeastTorque = 0.25;
constexpr double kAssumedTorque = 0.3;
// Velocities in units of sqrt(g / l): one number for all joints below the least does not swing a
// leg.
constexpr double kLeastVelocity = 0.6;
constexpr double kAssumedVelocity = 1.5;
// Radius of gyration that a link cannot have: above this fraction both of the distance of its
// farthest known point, as shapes may be smaller than the link, and of the leg.
constexpr double kGreatestGyration = 1.5;
constexpr double kGreatestGyrationOfLeg = 0.4;
// Least extent of a link without shapes and further joints.
constexpr double kLeastExtentOfLeg = 0.1;
// That of a ball, sqrt(2 / 5), of half of this size.
constexpr double kAssumedGyration = 0.32;

/** Distance of the farthest point that a link has, m: of its shapes, or of the next joints. */
double find_extent(const RobotModel& model, int index) {
  const Link& link = model.links()[index];
  double extent = 0;
  for (const auto* shapes : {&link.collisions, &link.visuals}) {
    for (const Shape& shape : *shapes) {
      if (shape.kind == Shape::Kind::kMesh) continue;
      const double end = std::max(0.5 * shape.size.norm(), shape.radius + 0.5 * shape.length);
      extent =
          std::max(extent, (shape.pose_in_link.translation() - link.center_of_mass).norm() + end);
    }
  }
  for (const Joint& joint : model.joints()) {
    if (joint.parent_link != index) continue;
    extent = std::max(extent, (joint.pose_in_parent.translation() - link.center_of_mass).norm());
  }
  return std::max(extent, link.center_of_mass.norm());
}

class Numbers {
 public:
  Numbers(const RobotModel& model, double leg, const std::string& file, TiXmlElement& robot)
      : model_(model),
        robot_(robot),
        leg_(leg),
        weight_torque_(model.total_mass() * kGravity * leg),
        rate_(std::sqrt(kGravity / leg)),
        log_{file, {}} {}

  Findings repair() {
    repair_limits("effort", "N m", &Joint::max_torque, kLeastTorque * weight_torque_,
                  kAssumedTorque * weight_torque_, kGreatestTorque * weight_torque_);
    repair_limits("velocity", "rad/s", &Joint::max_velocity, kLeastVelocity * rate_,
                  kAssumedVelocity * rate_, std::numeric_limits<double>::infinity());
    for (int link = 0; link < static_cast<int>(model_.links().size()); ++link) {
      repair_inertia(link);
    }
    return log_.findings;
  }

 private:
  TiXmlElement* find(const char* kind, const std::string& name) {
    for (TiXmlElement* element : child_elements(robot_, kind)) {
      if (element->Attribute("name") == name) return element;
    }
    return nullptr;
  }

  using JointNumber = double Joint::*;
  /** Replaces values above the greatest one, and one value below the least that all motors have. */
  void repair_limits(const char* attribute, const char* unit, JointNumber value, double least,
                     double assumed, double greatest) {
    const auto value_of = [&](int motor) { return model_.motor_joint(motor).*value; };
    bool is_placeholder = value_of(0) < least;
    for (int motor = 1; motor < model_.num_motors(); ++motor) {
      is_placeholder = is_placeholder && value_of(motor) == value_of(0);
    }
    for (int motor = 0; motor < model_.num_motors(); ++motor) {
      if (!is_placeholder && value_of(motor) <= greatest) continue;
      const std::string& name = model_.motor_joint(motor).name;
      TiXmlElement* joint = find("joint", name);
      TiXmlElement* limit = joint == nullptr ? nullptr : joint->FirstChildElement("limit");
      if (limit == nullptr) continue;
      limit->SetAttribute(attribute, to_text(assumed).c_str());
      log_.note(Finding::Severity::kRepaired, *limit, "joint " + name,
                std::string("has a greatest ") + attribute + " of " + rounded(value_of(motor)) +
                    " " + unit + ", too " + (is_placeholder ? "small" : "great") +
                    " for a robot of " + rounded(model_.total_mass()) + " kg",
                rounded(assumed) + " " + unit + " are assumed: write the motor's into <limit " +
                    attribute + "=>");
    }
  }

  void repair_inertia(int index) {
    const Link& link = model_.links()[index];
    if (link.mass <= 0) return;
    const double gyration = std::sqrt(link.inertia.diagonal().maxCoeff() / link.mass);
    const double extent = find_extent(model_, index);
    if (gyration <= kGreatestGyration * extent || gyration <= kGreatestGyrationOfLeg * leg_) return;
    TiXmlElement* element = find("link", link.name);
    TiXmlElement* inertial = element == nullptr ? nullptr : element->FirstChildElement("inertial");
    TiXmlElement* inertia = inertial == nullptr ? nullptr : inertial->FirstChildElement("inertia");
    if (inertia == nullptr) return;
    const double assumed =
        link.mass * std::pow(kAssumedGyration * std::max(extent, kLeastExtentOfLeg * leg_), 2);
    set_moment(*inertia, assumed);
    log_.note(Finding::Severity::kRepaired, *inertia, "link " + link.name,
              "has an inertia with a radius of gyration of " + rounded(gyration) +
                  " m, larger than the link",
              rounded(assumed) + " kg m^2 about each axis are assumed: write its <inertia>");
  }

  static std::string rounded(double number) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(3);
    text << number;
    return text.str();
  }

  const RobotModel& model_;
  TiXmlElement& robot_;
  double leg_;
  double weight_torque_;
  double rate_;
  RepairLog log_;
};

}  // namespace

std::string with_plausible_numbers(const std::string& text, const RobotModel& model, double leg,
                                   const std::string& file, Findings& findings) {
  TiXmlDocument document;
  document.Parse(text.c_str());
  TiXmlElement* robot = document.FirstChildElement("robot");
  if (robot == nullptr || model.num_motors() == 0 || !(leg > 0)) return text;
  const Findings found = Numbers(model, leg, file, *robot).repair();
  if (found.empty()) return text;
  findings.insert(findings.end(), found.begin(), found.end());
  return to_text(document);
}

}  // namespace nao
