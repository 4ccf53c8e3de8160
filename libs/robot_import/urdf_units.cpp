#include "robot_import/urdf_units.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "robot_import/urdf_values.h"
#include "robot_model/child_elements.h"

namespace nao {
namespace {

using Severity = Finding::Severity;

// Above a turn, with rounding: no joint of a humanoid and no rotation is as large in radians.
constexpr double kGreatestAngle = 2 * M_PI + 0.1;
// Of numbers in degrees.
constexpr double kGreatestDegrees = 360;
// Velocities of joints above this one are degrees per second where ranges are in degrees, rad/s.
constexpr double kGreatestVelocity = 40;
// The median distance of two joints in metres is below, in millimetres above.
constexpr double kGreatestMedian = 4;
// Mass by the cube of the longest chain, kg/m^3: published humanoids have 20 to 500.
constexpr double kGreatestDensity = 5000;
// Diagonal of a mesh, fraction of the longest chain.
constexpr double kGreatestMesh = 30;
constexpr double kLeastMesh = 1e-3;

using Visit = std::function<void(TiXmlElement&)>;

void for_each(TiXmlElement& element, const Visit& visit) {
  visit(element);
  for (TiXmlElement* child : child_elements(element)) {
    for_each(*child, visit);
  }
}

void multiply(TiXmlElement& element, const char* name, size_t count, double factor) {
  const auto numbers = read_numbers(element, name, count);
  if (!numbers) return;
  std::string text;
  for (const double number : *numbers) text += (text.empty() ? "" : " ") + to_text(number * factor);
  element.SetAttribute(name, text.c_str());
}

double origin_of(const TiXmlElement& joint) {
  return read_origin(joint).translation().norm();
}

/** Of a joint that turns between two angles: the greater one, rad as the file has it; 0: none. */
double greatest_angle(const TiXmlElement& joint) {
  const TiXmlElement* limit = joint.FirstChildElement("limit");
  if (limit == nullptr || text_of(joint, "type") != "revolute") return 0;
  return std::max(std::abs(read_number(*limit, "lower", 0)),
                  std::abs(read_number(*limit, "upper", 0)));
}

void repair_ranges(TiXmlElement& robot, RepairLog& log) {
  std::vector<TiXmlElement*> limits;
  int num_large = 0;
  int num_degrees = 0;
  TiXmlElement* first = nullptr;
  for (TiXmlElement* joint : child_elements(robot, "joint")) {
    const double angle = greatest_angle(*joint);
    if (angle == 0) continue;
    limits.push_back(joint->FirstChildElement("limit"));
    if (angle <= kGreatestAngle) continue;
    ++num_large;
    num_degrees += angle <= kGreatestDegrees ? 1 : 0;
    if (first == nullptr) first = limits.back();
  }
  // One range for all is a placeholder, as is one that some joints have.
  const bool is_one = std::all_of(limits.begin(), limits.end(), [&](const TiXmlElement* limit) {
    return read_number(*limit, "upper", 0) == read_number(*limits.front(), "upper", 0);
  });
  const bool is_degrees =
      num_degrees == num_large && 2 * num_large > static_cast<int>(limits.size()) && !is_one;
  if (is_degrees) {
    for (TiXmlElement* limit : limits) {
      multiply(*limit, "lower", 1, M_PI / 180);
      multiply(*limit, "upper", 1, M_PI / 180);
      if (read_number(*limit, "velocity", 0) > kGreatestVelocity) {
        multiply(*limit, "velocity", 1, M_PI / 180);
      }
    }
    log.note(Severity::kRepaired, *first, "",
             std::to_string(num_large) + " joints have ranges of more than a turn",
             "the ranges are taken for degrees: write radians");
    return;
  }
  for (TiXmlElement* limit : limits) {
    const TiXmlElement& joint = *limit->Parent()->ToElement();
    if (greatest_angle(joint) <= kGreatestAngle) continue;
    const auto text = [&](const char* name) {
      return limit->Attribute(name) == nullptr ? "none" : limit->Attribute(name);
    };
    log.note(Severity::kRepaired, *limit, title_of(joint),
             std::string("has a range of more than a turn, ") + text("lower") + " to " +
                 text("upper") + " rad",
             "-3.14 to 3.14 rad are assumed: write the real range");
    limit->SetAttribute("lower", "-3.14");
    limit->SetAttribute("upper", "3.14");
  }
}

void repair_rotations(TiXmlElement& robot, RepairLog& log) {
  int count = 0;
  TiXmlElement* first = nullptr;
  for_each(robot, [&](TiXmlElement& element) {
    if (element.ValueStr() != "origin") return;
    const auto rpy = read_numbers(element, "rpy", 3);
    if (!rpy || std::none_of(rpy->begin(), rpy->end(), [](double angle) {
          return std::abs(angle) > kGreatestAngle && std::abs(angle) <= kGreatestDegrees;
        })) {
      return;
    }
    multiply(element, "rpy", 3, M_PI / 180);
    if (count++ == 0) first = &element;
  });
  if (count == 0) return;
  log.note(Severity::kRepaired, *first, "",
           "rpy is more than a turn (" + std::to_string(count) + " times)",
           "these are taken for degrees: write radians");
}

void repair_lengths(TiXmlElement& robot, RepairLog& log) {
  std::vector<double> distances;
  for (const TiXmlElement* joint : child_elements(robot, "joint")) {
    if (origin_of(*joint) > 0) distances.push_back(origin_of(*joint));
  }
  if (distances.empty()) return;
  const auto middle = distances.begin() + static_cast<long>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  if (*middle <= kGreatestMedian) return;
  const double median = *middle;
  for_each(robot, [](TiXmlElement& element) {
    const std::string kind = element.ValueStr();
    if (kind == "origin") multiply(element, "xyz", 3, 1e-3);
    if (kind == "box") multiply(element, "size", 3, 1e-3);
    if (kind == "sphere" || kind == "cylinder" || kind == "capsule") {
      multiply(element, "radius", 1, 1e-3);
      multiply(element, "length", 1, 1e-3);
    }
    if (kind == "mesh") {
      if (!read_numbers(element, "scale", 3)) element.SetAttribute("scale", "1 1 1");
      multiply(element, "scale", 3, 1e-3);
    }
  });
  log.note(Severity::kRepaired, robot, "",
           "the joints are " + to_text(median) + " m from one another (median)",
           "the lengths are taken for millimetres: write metres");
}

void repair_masses(TiXmlElement& robot, RepairLog& log) {
  double mass = 0;
  for_each(robot, [&](TiXmlElement& element) {
    if (element.ValueStr() == "mass") mass += std::max(0.0, read_number(element, "value", 0));
  });
  const double chain = measure_chain(robot);
  const double greatest = kGreatestDensity * chain * chain * chain;
  // Of one mass that cannot be nothing follows for the others.
  if (!(chain > 0) || mass <= greatest || mass > 1e5 * greatest) return;
  for_each(robot, [](TiXmlElement& element) {
    if (element.ValueStr() == "mass") multiply(element, "value", 1, 1e-3);
    if (element.ValueStr() != "inertia") return;
    for (const char* name : {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"}) {
      multiply(element, name, 1, 1e-3);
    }
  });
  log.note(Severity::kRepaired, robot, "",
           "has a mass of " + to_text(mass) + " kg with limbs of " + to_text(chain) + " m",
           "the masses are taken for grams: write kilograms");
}

}  // namespace

double measure_chain(const TiXmlElement& robot) {
  std::multimap<std::string, const TiXmlElement*> joints;
  for (const TiXmlElement* joint : child_elements(robot, "joint")) {
    joints.emplace(link_of(*joint, "parent"), joint);
  }
  double longest = 0;
  std::vector<std::pair<std::string, double>> reached;
  for (const TiXmlElement* link : child_elements(robot, "link")) {
    const char* name = link->Attribute("name");
    const bool is_root =
        name != nullptr && std::none_of(joints.begin(), joints.end(), [&](const auto& joint) {
          return link_of(*joint.second, "child") == name;
        });
    if (is_root) reached.emplace_back(name, 0.0);
  }
  for (size_t i = 0; i < reached.size() && i <= 2 * joints.size(); ++i) {
    const auto [name, distance] = reached[i];
    longest = std::max(longest, distance);
    const auto [begin, end] = joints.equal_range(name);
    for (auto joint = begin; joint != end; ++joint) {
      // Where a file places a robot in a world does not matter.
      const double length = i == 0 && std::next(begin) == end ? 0 : origin_of(*joint->second);
      reached.emplace_back(link_of(*joint->second, "child"), distance + length);
    }
  }
  return longest;
}

void repair_units(TiXmlElement& robot, RepairLog& log) {
  repair_ranges(robot, log);
  repair_rotations(robot, log);
  repair_lengths(robot, log);
  repair_masses(robot, log);
}

double mesh_unit(double extent, double chain) {
  if (!(chain > 0) || !(extent > 0)) return 1;
  if (extent > kGreatestMesh * chain) return 1e-3;
  return extent < kLeastMesh * chain ? 1e3 : 1;
}

}  // namespace nao
