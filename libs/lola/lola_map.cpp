#include "lola/lola_map.h"

#include <algorithm>
#include <type_traits>

#include "common/yaml_entry.h"

namespace nao {
namespace {

std::vector<YamlEntry> items(const YamlEntry& list, size_t count) {
  std::vector<YamlEntry> result = list.items();
  if (result.size() != count) {
    list.fail("has " + std::to_string(result.size()) + " entries and must have " +
              std::to_string(count));
  }
  return result;
}

double read_sign(const YamlEntry& entry) {
  const double sign = entry.number();
  if (sign != 1 && sign != -1) entry.fail("must be 1 or -1");
  return sign;
}

int read_motor(const RobotModel& model, const YamlEntry& entry, const std::string& name) {
  const int motor = model.find_motor(name);
  if (motor < 0) entry.fail("names \"" + name + "\", which is not a joint with a motor");
  return motor;
}

// All motors exactly once: LoLA's arrays have no room for others, and a motor that is not listed
// would never move.
void read_joints(const RobotModel& model, const YamlEntry& list, LolaMap& map) {
  if (model.num_motors() != static_cast<int>(kLolaJoints)) {
    list.fail("is for " + std::to_string(kLolaJoints) + " motors; the robot has " +
              std::to_string(model.num_motors()));
  }
  std::vector<bool> is_listed(kLolaJoints, false);
  size_t i = 0;
  for (const YamlEntry& entry : items(list, kLolaJoints)) {
    entry.allow_only({"joint", "sign"});
    const int motor = read_motor(model, entry.at("joint"), entry.at("joint").text());
    if (is_listed[static_cast<size_t>(motor)]) entry.fail("names a joint for the second time");
    is_listed[static_cast<size_t>(motor)] = true;
    map.joints[i++] = {motor, read_sign(entry.at("sign"))};
  }
}

void read_foot_sensors(const RobotModel& model, const YamlEntry& list, LolaMap& map) {
  size_t i = 0;
  for (const YamlEntry& entry : items(list, map.foot_sensors.size())) {
    const std::vector<int>& links = model.foot_sensors();
    const auto link = std::find(links.begin(), links.end(), model.find_link(entry.text()));
    if (link == links.end()) entry.fail("names a foot sensor that the robot does not have");
    map.foot_sensors[i++] = static_cast<int>(link - links.begin());
  }
}

template <size_t N>
void read_names(const YamlEntry& list, std::array<std::string, N>& names) {
  size_t i = 0;
  for (const YamlEntry& entry : items(list, N)) names[i++] = entry.text();
}

template <size_t N>
void read_signs(const YamlEntry& list, std::array<double, N>& signs) {
  size_t i = 0;
  for (const YamlEntry& entry : items(list, N)) signs[i++] = read_sign(entry);
}

template <class Values>
// Lights are all arrays of floats except the joints'.
constexpr bool kIsLight = false;
template <size_t N>
constexpr bool kIsLight<std::array<float, N>> = N != kLolaJoints;

/** Calls `act(values)` with the optional values of a group of lights. @return Whether there is one.
 */
template <class Command, class Act>
bool with_light(Command& command, const std::string& key, Act&& act) {
  bool is_found = false;
  for_each_field(command, [&](const char* name, auto& values) {
    using Values = typename std::remove_cvref_t<decltype(values)>::value_type;
    if constexpr (kIsLight<Values>) {
      if (key != name) return;
      is_found = true;
      act(values);
    }
  });
  return is_found;
}

/** Lights of one color in a group; 0 if they are white. One colored light has 3 values, the eight
 * of an eye 24; ears have 10 white ones and the skull 12. */
size_t num_per_color(size_t num_values) {
  return num_values == 3 || num_values == 24 ? num_values / 3 : 0;
}

}  // namespace

LolaMap LolaMap::load(const RobotModel& model) {
  const YamlEntry file = YamlEntry::load(model.folder() / "lola.yaml");
  file.allow_only({"joints", "accelerometer_signs", "gyroscope_signs", "foot_sensors", "touch",
                   "start_button", "sonars", "lights", "torque_per_current", "seated_stiffness"});
  LolaMap map;
  read_joints(model, file.at("joints"), map);
  read_signs(file.at("accelerometer_signs"), map.accelerometer_sign);
  read_signs(file.at("gyroscope_signs"), map.gyroscope_sign);
  read_foot_sensors(model, file.at("foot_sensors"), map);
  read_names(file.at("touch"), map.touch);
  read_names(file.at("sonars"), map.sonars);
  const std::string button = file.at("start_button").text();
  const auto found = std::find(map.touch.begin(), map.touch.end(), button);
  if (found == map.touch.end()) file.at("start_button").fail("names no entry of touch");
  map.start_button = static_cast<size_t>(found - map.touch.begin());
  // A key is known if setting its light works.
  LolaCommand probe;
  for (const auto& [name, key] : file.at("lights").entries()) {
    if (!set_light(probe, key.text(), {0, 0, 0}))
      key.fail("is not a key of lights in LoLA's commands");
    map.lights.push_back({name, key.text()});
  }
  map.torque_per_current = file.at("torque_per_current").positive();
  map.seated_stiffness.assign(static_cast<size_t>(model.num_motors()), 0);
  for (const auto& [name, value] : file.at("seated_stiffness").entries()) {
    const double stiffness = value.not_negative();
    if (stiffness > 1) value.fail("must be 0 to 1");
    map.seated_stiffness[static_cast<size_t>(read_motor(model, value, name))] = stiffness;
  }
  return map;
}

// Joint arrays in LoLA's order; signs for angles only, since stiffness has none.
std::array<float, kLolaJoints> LolaMap::to_lola(std::span<const double> values,
                                                bool is_angle) const {
  std::array<float, kLolaJoints> result{};
  for (size_t i = 0; i < kLolaJoints; ++i) {
    const double sign = is_angle ? joints[i].sign : 1;
    result[i] = static_cast<float>(sign * values[static_cast<size_t>(joints[i].motor)]);
  }
  return result;
}

void LolaMap::from_lola(const std::array<float, kLolaJoints>& values, bool is_angle,
                        std::span<double> result) const {
  for (size_t i = 0; i < kLolaJoints; ++i) {
    const double sign = is_angle ? joints[i].sign : 1;
    result[static_cast<size_t>(joints[i].motor)] = sign * static_cast<double>(values[i]);
  }
}

bool set_light(LolaCommand& command, const std::string& key, const std::array<double, 3>& rgb) {
  return with_light(command, key, [&](auto& values) {
    auto& lights = values.emplace();
    // All red values come first, then all green, then all blue; white lights get the brightest
    // part.
    const size_t num = num_per_color(lights.size());
    for (size_t i = 0; i < lights.size(); ++i) {
      lights[i] =
          static_cast<float>(num > 0 ? rgb[i / num] : *std::max_element(rgb.begin(), rgb.end()));
    }
  });
}

// The mean over the lights of a group, 0 to 1; black where the command does not have the key.
std::array<double, 3> light_color(const LolaCommand& command, const std::string& key) {
  std::array<double, 3> rgb{};
  with_light(command, key, [&](const auto& values) {
    if (!values) return;
    const size_t num = num_per_color(values->size());
    for (size_t i = 0; i < values->size(); ++i) {
      const double value = (*values)[i];
      if (num > 0) {
        rgb[i / num] += value / static_cast<double>(num);
      } else {
        for (double& part : rgb) part += value / static_cast<double>(values->size());
      }
    }
  });
  return rgb;
}

}  // namespace nao
