#pragma once

#include <functional>
#include <memory>
#include <string>

#include "daemons/play/situation.h"
#include "sim/closed_loop/closed_loop.h"

namespace nao::trial {

/** Time from an image until its contents are known, s: exposure, compression, nao-vision's
 * processing and the bus on a busy host. Chosen. */
constexpr double kImageLatency = 0.08;

/** What a robot in a trial knows from its cameras. The field is the simulated world; the opponents'
 * side is x > 0 for team 0, x < 0 for team 1. */
class TrialPerception {
 public:
  virtual ~TrialPerception() = default;
  /** To be called after every tick. @param camera  Camera whose images are requested; empty: none.
   * @return What is known now. */
  virtual const play::Vision& step(const std::string& camera) = 0;
};

/** Makes the perception of one trial, which must outlive it. @param start  Assumed pose of the
 * robot on the field as its team sees it. @param team  0: it plays along the world's x axis. */
using PerceptionFactory = std::function<std::unique_ptr<TrialPerception>(
    ClosedLoop& trial, const SceneFile& scene, const Pose2& start, uint64_t seed, int team)>;

/** Assumed pose of a robot that was placed on the field by hand: uniform errors with standard
 * deviations of 0.07 m and 3 degrees. Chosen.
 * @param random  Uniform in [low, high). */
inline Pose2 told_start(const Pose2& truth, const std::function<double(double, double)>& random) {
  // Half a width of sqrt(3) standard deviations.
  const auto deviation = [&](double sigma) { return random(-1.732, 1.732) * sigma; };
  return {truth.position + Eigen::Vector2d(deviation(0.07), deviation(0.07)),
          truth.heading + deviation(0.052)};
}

}  // namespace nao::trial
