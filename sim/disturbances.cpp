#include "sim/disturbances.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/constants.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/yaml_entry.h"

namespace nao::sim {
namespace {

/** A unit that a file may name, and its size in the unit that the simulator uses. */
struct Unit {
  const char* name;
  double size;
};
using Units = std::vector<Unit>;
const Units kRatio{{"1", 1}};
const Units kAngle{{"rad", 1}, {"deg", kDegree}};
const Units kRate{{"rad/s", 1}, {"deg/s", kDegree}};
const Units kLength{{"m", 1}, {"mm", 1e-3}};
const Units kStiffness{{"N/m", 1}};
const Units kMilliseconds{{"ms", 1}};

/** Properties of a disturbance in a file. */
struct Rule {
  const char* name;
  const Units& units;
  /** Words that `per` may have. */
  std::vector<const char*> per;
  /** Range of all numbers, and of what is drawn. Chosen: beyond any robot that walks, and within
   * what the physics computes without failing. */
  double least;
  double most;
};

/** In the order of Disturbance. */
const std::vector<Rule>& rules() {
  // Chosen: more than ten times the value of the joints in `real`.
  constexpr double kMaxPlay = 20 * kDegree;
  static const std::vector<Rule> all{
      {"backlash.hip", kAngle, {"joint"}, 0, kMaxPlay},
      {"backlash.knee", kAngle, {"joint"}, 0, kMaxPlay},
      {"backlash.ankle", kAngle, {"joint"}, 0, kMaxPlay},
      {"backlash.arm", kAngle, {"joint"}, 0, kMaxPlay},
      {"backlash.head", kAngle, {"joint"}, 0, kMaxPlay},
      {"joint_zero", kAngle, {"joint"}, -0.5, 0.5},
      {"imu_mount", kAngle, {"robot"}, -0.5, 0.5},
      {"gyroscope_scale", kRatio, {"robot"}, 0, 10},
      {"gyroscope_offset", kRate, {"robot"}, -10, 10},
      {"accelerometer_scale", kRatio, {"robot"}, 0, 10},
      {"imu_alternate", kRatio, {"robot"}, 0, 1},
      {"foot_sensor_scale", kRatio, {"foot"}, 0, 10},
      {"foot_sensor_dead_probability", kRatio, {"robot"}, 0, 1},
      {"floor_slope", kAngle, {"robot"}, 0, 45 * kDegree},
      {"floor_bump_height", kLength, {"robot"}, 0, 0.02},
      {"floor_bump_grid", kLength, {"robot"}, 0.02, 10},
      {"contact_stiffness", kStiffness, {"robot"}, 1e3, 1e6},
      {"friction", kRatio, {"robot"}, 0.01, 10},
      {"torque_scale", kRatio, {"robot"}, 0.01, 10},
      {"servo_stiffness", kRatio, {"group"}, 0.1, 10},
      {"servo_damping", kRatio, {"group"}, 0.1, 10},
      {"mass_scale", kRatio, {"robot"}, 0.1, 10},
      {"torso_com", kLength, {"robot"}, -0.05, 0.05},
      {"tick_ms", kMilliseconds, {"robot"}, 2, 100},
      {"command_latency_ms", kMilliseconds, {"robot"}, 0, 1000},
      {"sensor_loss", kRatio, {"tick"}, 0, 0.9},
      {"command_loss", kRatio, {"tick"}, 0, 0.9},
  };
  return all;
}

const std::string kBacklash = "backlash";

/** The name of a disturbance as it is given on a command line: all classes of joints together. */
std::string key_of(const std::string& name) {
  return name.substr(0, name.find('.'));
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/** Names after a prefix: "" for the keys of a file, "backlash." for the classes of joints. */
std::vector<std::string> names_after(const std::string& prefix) {
  std::vector<std::string> names;
  for (const Rule& rule : rules()) {
    const std::string name = rule.name;
    if (name.rfind(prefix, 0) != 0) continue;
    const std::string rest = key_of(name.substr(prefix.size()));
    if (std::find(names.begin(), names.end(), rest) == names.end()) names.push_back(rest);
  }
  return names;
}

// A number of the file in the simulator's unit. Errors give the range in the file's own unit.
double read_size(const YamlEntry& entry, const Rule& rule, const Unit& unit, double least) {
  const double number = entry.number() * unit.size;
  // Conversion of units must not reject the limits themselves.
  constexpr double kRounding = 1e-9;
  const double slack = kRounding * std::max(std::abs(least), std::abs(rule.most));
  if (number < least - slack || number > rule.most + slack) {
    std::ostringstream text;
    text << "is outside [" << least / unit.size << ", " << rule.most / unit.size << "] "
         << unit.name;
    entry.fail(text.str());
  }
  return number;
}

Unit read_unit(const YamlEntry& entry, const Rule& rule) {
  // Collects the allowed names for the error message; entry.fail() throws.
  const std::string name = entry.text();
  std::vector<std::string> names;
  for (const Unit& unit : rule.units) {
    if (name == unit.name) return unit;
    names.emplace_back(unit.name);
  }
  entry.fail("is \"" + name + "\" and must be " + joined(names));
}

Distribution read_distribution(const YamlEntry& entry, const Rule& rule) {
  entry.allow_only({"value", "uniform", "sigma", "unit", "per", "source"});
  const Unit unit = read_unit(entry.at("unit"), rule);
  const std::string per = entry.at("per").text();
  if (std::find(rule.per.begin(), rule.per.end(), per) == rule.per.end()) {
    entry.at("per").fail("is \"" + per + "\" and must be " +
                         joined({rule.per.begin(), rule.per.end()}));
  }
  // The source of a number is required, but only for people.
  entry.at("source").text();
  // Each has() is 0 or 1.
  if (entry.has("value") + entry.has("uniform") + entry.has("sigma") != 1) {
    entry.fail("must have exactly one of value, uniform and sigma");
  }
  Distribution distribution;
  distribution.least = rule.least;
  distribution.most = rule.most;
  if (entry.has("value")) {
    distribution.a = read_size(entry.at("value"), rule, unit, rule.least);
  } else if (entry.has("uniform")) {
    const YamlEntry range = entry.at("uniform");
    if (range.items().size() != 2) range.fail("must be two numbers");
    distribution.kind = Distribution::Kind::kUniform;
    distribution.a = read_size(range.items()[0], rule, unit, rule.least);
    distribution.b = read_size(range.items()[1], rule, unit, rule.least);
    if (distribution.a > distribution.b) range.fail("must be a lower and an upper end");
  } else {
    distribution.kind = Distribution::Kind::kSigma;
    distribution.a = read_size(entry.at("sigma"), rule, unit, 0);
    // A normal distribution is about 0.
    if (rule.least > 0) entry.at("sigma").fail("cannot be 0, which sigma is about; use uniform");
  }
  return distribution;
}

}  // namespace

const std::array<const char*, kNumDisturbances>& disturbance_names() {
  static const auto names = [] {
    std::array<const char*, kNumDisturbances> result{};
    for (size_t i = 0; i < kNumDisturbances; ++i) result[i] = rules().at(i).name;
    return result;
  }();
  return names;
}

// Clamped after the draw: a normal distribution has tails, and the rule's range is what the physics
// can compute.
double Distribution::draw(Random& random) const {
  double drawn = a;
  if (kind == Kind::kUniform) drawn = random.uniform(a, b);
  if (kind == Kind::kSigma) drawn = a * random.normal();
  return std::clamp(drawn, least, most);
}

DisturbanceSet DisturbanceSet::load(const std::filesystem::path& file) {
  DisturbanceSet set;
  const YamlEntry whole = YamlEntry::load<ConfigError>(file);
  set.read(whole);
  set.name_ = file.stem().string();
  return set;
}

DisturbanceSet DisturbanceSet::parse(const std::string& text, const std::string& name) {
  DisturbanceSet set;
  set.read(YamlEntry::parse<ConfigError>(text, name));
  set.name_ = name;
  return set;
}

void DisturbanceSet::read(const YamlEntry& whole) {
  // The lambda gets itself as an argument to recurse into "backlash", whose entries are the classes
  // of joints; all other entries are distributions.
  const auto read_all = [this](const YamlEntry& part, const std::string& prefix,
                               auto&& self) -> void {
    for (const auto& [key, entry] : part.entries()) {
      const std::string name = prefix + key;
      if (name == kBacklash) {
        self(entry, kBacklash + ".", self);
        continue;
      }
      const auto rule = std::find_if(rules().begin(), rules().end(),
                                     [&](const Rule& each) { return each.name == name; });
      if (rule == rules().end()) {
        entry.fail("is unknown; allowed are " + joined(names_after(prefix)));
      }
      entries_[static_cast<size_t>(rule - rules().begin())] = read_distribution(entry, *rule);
    }
  };
  read_all(whole, "", read_all);
}

DisturbanceSet DisturbanceSet::find(const std::string& name_or_list) {
  const std::filesystem::path folder = data_path() / "disturbances";
  // A word without separators is a file's name first; otherwise a list of entries of real.yaml.
  const bool is_word = name_or_list.find_first_of("/.,") == std::string::npos;
  const auto file = folder / (name_or_list + ".yaml");
  if (is_word && std::filesystem::is_regular_file(file)) return load(file);
  const DisturbanceSet real = load(folder / "real.yaml");
  DisturbanceSet set;
  set.name_ = name_or_list;
  std::istringstream words(name_or_list);
  std::string word;
  bool has_any = false;
  while (std::getline(words, word, ',')) {
    bool is_known = false;
    for (size_t i = 0; i < kNumDisturbances; ++i) {
      // "backlash" selects all of its classes, so that one word may match several entries.
      if (key_of(rules()[i].name) != word || !real.entries_[i]) continue;
      set.entries_[i] = real.entries_[i];
      is_known = true;
    }
    if (!is_known) {
      throw ConfigError("\"" + word + "\" is neither a file of " + folder.string() +
                        " nor an entry of its real.yaml; entries are " + joined(real.keys()));
    }
    has_any = true;
  }
  if (!has_any) throw ConfigError("disturbances are the name of a file or a list, not \"\"");
  return set;
}

bool DisturbanceSet::is_none() const {
  return std::none_of(entries_.begin(), entries_.end(),
                      [](const auto& entry) { return entry.has_value(); });
}

std::vector<std::string> DisturbanceSet::keys() const {
  std::vector<std::string> keys;
  for (size_t i = 0; i < kNumDisturbances; ++i) {
    const std::string key = key_of(rules()[i].name);
    // Entries of one key are neighbors in rules(): comparing with the last key suffices.
    if (entries_[i] && (keys.empty() || keys.back() != key)) keys.push_back(key);
  }
  return keys;
}

}  // namespace nao::sim
