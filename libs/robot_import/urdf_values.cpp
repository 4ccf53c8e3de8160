#include "robot_import/urdf_values.h"

#include <tinyxml.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace nao {

namespace {

std::optional<std::vector<double>> to_numbers(const std::string& text, size_t count) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  std::vector<double> numbers;
  for (double number = 0; stream >> number;) numbers.push_back(number);
  // All of the text must be numbers, and as many as asked for.
  const bool is_right = stream.eof() && numbers.size() == count &&
                        std::all_of(numbers.begin(), numbers.end(),
                                    [](double number) { return std::isfinite(number); });
  return is_right ? std::optional(numbers) : std::nullopt;
}

}  // namespace

std::optional<std::vector<double>> read_numbers(const TiXmlElement& element, const char* name,
                                                size_t count) {
  const char* text = element.Attribute(name);
  return text == nullptr ? std::nullopt : to_numbers(text, count);
}

std::string repaired_numbers(const TiXmlElement& element, const char* name, size_t count) {
  std::string spaces = element.Attribute(name);
  std::string points = spaces;
  for (const char separator : {',', ';'})
    std::replace(spaces.begin(), spaces.end(), separator, ' ');
  if (to_numbers(spaces, count)) return spaces;
  std::replace(points.begin(), points.end(), ',', '.');
  if (to_numbers(points, count)) return points;
  // MuJoCo and some exporters write one scale for all axes.
  if (count == 3 && to_numbers(points, 1)) return points + " " + points + " " + points;
  return "";
}

double read_number(const TiXmlElement& element, const char* name, double otherwise) {
  const auto numbers = read_numbers(element, name, 1);
  return numbers ? numbers->front() : otherwise;
}

std::string text_of(const TiXmlElement& element, const char* name) {
  const char* text = element.Attribute(name);
  return text == nullptr ? "" : text;
}

std::string title_of(const TiXmlElement& element) {
  return element.ValueStr() + " " + text_of(element, "name");
}

std::string link_of(const TiXmlElement& joint, const char* end) {
  const TiXmlElement* element = joint.FirstChildElement(end);
  return element == nullptr ? "" : text_of(*element, "link");
}

double mass_of(const TiXmlElement& link) {
  const TiXmlElement* inertial = link.FirstChildElement("inertial");
  const TiXmlElement* mass = inertial ? inertial->FirstChildElement("mass") : nullptr;
  return mass == nullptr ? 0 : read_number(*mass, "value", 0);
}

TiXmlElement& find_or_add(TiXmlElement& parent, const char* name) {
  TiXmlElement* child = parent.FirstChildElement(name);
  return child != nullptr ? *child : *parent.LinkEndChild(new TiXmlElement(name))->ToElement();
}

double ball_moment(double mass) {
  constexpr double kDensity = 1000;  // kg/m^3, about that of motors in plastic shells
  const double radius = std::cbrt(3 * mass / (4 * M_PI * kDensity));
  // A solid ball: 2/5 m r^2.
  return 0.4 * mass * radius * radius;
}

void set_moment(TiXmlElement& inertia, double moment) {
  for (const char* name : {"ixx", "iyy", "izz"}) {
    inertia.SetAttribute(name, to_text(moment).c_str());
  }
  for (const char* name : {"ixy", "ixz", "iyz"}) inertia.SetAttribute(name, "0");
}

TiXmlElement make_inertial(double mass) {
  TiXmlElement inertial("inertial");
  TiXmlElement value("mass");
  value.SetAttribute("value", to_text(mass).c_str());
  inertial.InsertEndChild(value);
  TiXmlElement inertia("inertia");
  set_moment(inertia, ball_moment(mass));
  inertial.InsertEndChild(inertia);
  return inertial;
}

std::string to_text(const TiXmlDocument& document) {
  TiXmlPrinter printer;
  document.Accept(&printer);
  return printer.Str();
}

std::string to_text(double number) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(12);
  text << number;
  return text.str();
}

std::string to_text(const Eigen::Vector3d& vector) {
  return to_text(vector.x()) + " " + to_text(vector.y()) + " " + to_text(vector.z());
}

Eigen::Isometry3d read_origin(const TiXmlElement& parent) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const TiXmlElement* origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return pose;
  if (const auto xyz = read_numbers(*origin, "xyz", 3)) {
    pose.translation() = Eigen::Vector3d(xyz->data());
  }
  // URDF: fixed axes roll, pitch, yaw, that is R = Rz Ry Rx.
  if (const auto rpy = read_numbers(*origin, "rpy", 3)) {
    pose.linear() = (Eigen::AngleAxisd((*rpy)[2], Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd((*rpy)[1], Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd((*rpy)[0], Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
  }
  return pose;
}

void write_origin(TiXmlElement& parent, const Eigen::Isometry3d& pose) {
  TiXmlElement& origin = find_or_add(parent, "origin");
  origin.SetAttribute("xyz", to_text(Eigen::Vector3d(pose.translation())).c_str());
  origin.SetAttribute("rpy", to_text(to_rpy(pose.linear())).c_str());
}

Eigen::Vector3d to_rpy(const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix3d& r = rotation;
  return {std::atan2(r(2, 1), r(2, 2)), std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2))),
          std::atan2(r(1, 0), r(0, 0))};
}

}  // namespace nao
