#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/random.h"

namespace nao {
class YamlEntry;
}

namespace nao::sim {

/** What can disturb a robot or its floor; disturbance_names() has the names in files. */
enum class Disturbance {
  kBacklashHip,
  kBacklashKnee,
  kBacklashAnkle,
  kBacklashArm,
  kBacklashHead,
  kJointZero,
  kImuMount,
  kGyroscopeScale,
  kGyroscopeOffset,
  kAccelerometerScale,
  kImuAlternate,
  kFootSensorScale,
  kFootSensorDeadProbability,
  kFloorSlope,
  kFloorBumpHeight,
  kFloorBumpGrid,
  kContactStiffness,
  kFriction,
  kTorqueScale,
  kServoStiffness,
  kServoDamping,
  kMassScale,
  kTorsoCom,
  kTickMs,
  kCommandLatencyMs,
  kSensorLoss,
  kCommandLoss,
  kCount
};
inline constexpr size_t kNumDisturbances = static_cast<size_t>(Disturbance::kCount);

/** Names in files, in the order of Disturbance: "backlash.hip", ..., "joint_zero", ... */
const std::array<const char*, kNumDisturbances>& disturbance_names();

/** How a disturbance is distributed over robots, in SI units and rad (times: ms). */
struct Distribution {
  enum class Kind { kValue, kUniform, kSigma };
  Kind kind = Kind::kValue;
  /** The value; the lower end; or the standard deviation of a normal distribution about 0. */
  double a = 0;
  /** The upper end. */
  double b = 0;
  /** Values drawn outside this range are set to its nearer end. */
  double least = 0;
  double most = 0;

  double draw(Random& random) const;
};

/** Which disturbances act on a robot, and how each is distributed: a file in disturbances/ of the
 * data folder, or some of its entries.
 *
 * A file has one line for each key; docs/physics.md describes keys and units:
 *
 *     KEY: {value: x | uniform: [a, b] | sigma: s, unit: ..., per: robot|joint|group|foot|tick,
 *           source: "..."}
 *
 * `backlash` has such an entry for each class of joints. A key that is absent disturbs nothing. */
class DisturbanceSet {
 public:
  /** No disturbance: sensors are ideal and motors follow at once (is_none()). */
  DisturbanceSet() = default;

  /** Reads a file.
   * @throws ConfigError  with file and line, for an unknown key, unit or number out of range. */
  static DisturbanceSet load(const std::filesystem::path& file);
  /** Parses a text; errors name it `name`. @throws ConfigError */
  static DisturbanceSet parse(const std::string& text, const std::string& name);
  /** @param name_or_list  Name of a file ("real"), or entries of real.yaml, with commas between
   * them
   * ("backlash,floor_slope"): only they disturb the robot.
   * @throws ConfigError  if there is neither such a file nor such an entry. */
  static DisturbanceSet find(const std::string& name_or_list);

  /** As given to find(). */
  const std::string& name() const { return name_; }
  /** Whether there is no entry at all. */
  bool is_none() const;
  /** Keys that have an entry, as a file names them; `backlash` once. */
  std::vector<std::string> keys() const;
  /** Nothing if it does not disturb the robot. */
  const std::optional<Distribution>& entry(Disturbance disturbance) const {
    return entries_[static_cast<size_t>(disturbance)];
  }

 private:
  void read(const YamlEntry& whole);

  std::string name_ = "none";
  std::array<std::optional<Distribution>, kNumDisturbances> entries_;
};

}  // namespace nao::sim
