#include "robot_model/robot_lights.h"

#include <cmath>
#include <filesystem>
#include <set>

#include "common/error.h"
#include "common/logger.h"
#include "common/yaml_entry.h"

namespace nao {
namespace {

/** Allowed deviation of a normal's length from 1: numbers of four digits. */
constexpr double kNormTolerance = 1e-3;

Eigen::Vector3d read_vector(const YamlEntry& entry) {
  const std::vector<double> numbers = entry.numbers(3);
  return {numbers[0], numbers[1], numbers[2]};
}

RobotLight::Disc read_disc(const YamlEntry& entry) {
  entry.allow_only({"center", "normal", "radius", "inner_radius"});
  RobotLight::Disc disc;
  disc.center = read_vector(entry.at("center"));
  disc.normal = read_vector(entry.at("normal"));
  if (!(std::abs(disc.normal.norm() - 1) < kNormTolerance)) {
    entry.at("normal").fail("must have length 1");
  }
  disc.normal.normalize();
  disc.radius = entry.at("radius").positive();
  if (entry.has("inner_radius")) disc.inner_radius = entry.at("inner_radius").not_negative();
  if (disc.inner_radius >= disc.radius) entry.at("inner_radius").fail("must be below the radius");
  return disc;
}

RobotLight read_light(const RobotModel& model, const YamlEntry& entry) {
  entry.allow_only({"name", "labels", "link", "eye", "discs"});
  RobotLight light;
  light.name = entry.at("name").text();
  if (entry.has("labels")) {
    for (const auto& [language, text] : entry.at("labels").entries()) {
      light.labels[language] = text.text();
    }
  }
  light.link = model.find_link(entry.at("link").text());
  if (light.link < 0) entry.at("link").fail("is not a link in the URDF");
  if (entry.has("eye")) light.is_eye = entry.at("eye").flag();
  for (const YamlEntry& disc : entry.at("discs").items()) light.discs.push_back(read_disc(disc));
  return light;
}

std::vector<RobotLight> read_lights(const RobotModel& model, const std::filesystem::path& path) {
  std::vector<RobotLight> lights;
  const YamlEntry file = YamlEntry::load(path);
  file.allow_only({"lights"});
  std::set<std::string> names;
  for (const YamlEntry& entry : file.at("lights").items()) {
    lights.push_back(read_light(model, entry));
    if (!names.insert(lights.back().name).second) entry.at("name").fail("appears twice");
  }
  return lights;
}

}  // namespace

std::vector<RobotLight> load_robot_lights(const RobotModel& model) {
  const std::filesystem::path path = model.folder() / "lights.yaml";
  if (!std::filesystem::exists(path)) return {};
  try {
    return read_lights(model, path);
  } catch (const Error& error) {
    logger::warn("{}; the robot has no lights", error.what());
    return {};
  }
}

std::vector<std::string> names_of(const std::vector<RobotLight>& lights) {
  std::vector<std::string> names;
  for (const RobotLight& light : lights) names.push_back(light.name);
  return names;
}

}  // namespace nao
