#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/yaml_entry.h"

namespace nao::motion {

/** Tells from joints and gyroscope whether a kicking foot met a ball, which slows it down.
 *
 * Score = bias + sum of weights times signals at fixed times after the foot has passed a line on
 * its way forward. Fitted for one kick at its own strength; the kick's file has the numbers. */
struct KickImpact {
  /** Of the kicking leg the velocities of the hip's pitch joint and of the knee, rad/s, and the
   * torques of both, N m; of the torso the angular velocities about y and z, rad/s, the latter
   * positive towards the kicking side; of the supporting leg the two torques, N m. */
  static constexpr int kNumSignals = 8;

  /** The line: the sole's origin is so far ahead of the torso's, m. */
  double foot = 0;
  /** s after the foot has passed it. */
  std::vector<double> times;
  /** Weights of each signal, one for each of the times. */
  std::array<std::vector<double>, kNumSignals> weights;
  double bias = 0;
  /** Least and greatest size of a score that is believed: positive scores are hits, negative ones
   * misses. Beyond the greatest one the kick was unlike those of the fit. */
  std::array<double, 2> believed{};

  /** @throws ModelError  naming the line and what is wrong with it. */
  static KickImpact read(const YamlEntry& entry);

  /** One control step of a kick. */
  struct Sample {
    /** s since the start of the kick. */
    double time = 0;
    /** Position of the kicking sole ahead of the torso, m. */
    double foot = 0;
    std::array<double, kNumSignals> signals{};
  };

  /** The signals at the times, one signal after the other; empty if the foot did not pass the line,
   * or the samples end before the last time. @param samples  In order of time. */
  std::vector<double> find_features(const std::vector<Sample>& samples) const;

  /** Whether the foot met a ball; nothing if that is not sure. */
  std::optional<bool> judge(const std::vector<Sample>& samples) const;
};

}  // namespace nao::motion
