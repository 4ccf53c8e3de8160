#include "tools/transition-tuner/get_up_course.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "tools/nao-trial/lying_start.h"

namespace nao {
namespace {

constexpr double kTimeout = 14;  // s for one try
constexpr double kSpread = 0.6;  // rad, either side of how it shall lie
// Cost of a failed try, s, above kTimeout; and its reduction at full torso height, s, so that a
// failed try always costs as much as a success at the timeout.
constexpr double kFailed = 20;
constexpr double kHeightCounts = 6;

/** Direction of the push that makes the robot lie so, or rotation about its long axis, rad. */
double direction_of(GetUpCourse::Start start) {
  switch (start) {
    case GetUpCourse::Start::kBack:
      return M_PI;
    case GetUpCourse::Start::kLeft:
      return M_PI / 2;
    case GetUpCourse::Start::kRight:
      return -M_PI / 2;
    default:
      return 0;
  }
}

}  // namespace

GetUpResult GetUpCourse::run(const motion::TransitionGraph& transitions, uint64_t seed) const {
  ClosedLoopOptions options;
  options.model = model_;
  options.scene = scene_;
  options.motion.transitions = transitions;
  ClosedLoop trial(options, seed);
  const double standing = model_->references().heights.standing;
  const double spread = start_ == Start::kAny ? M_PI : kSpread;
  const double direction = direction_of(start_) + trial.random(-spread, spread);
  trial.run(0.5);
  if (seed % 2 == 1) {
    trial::knock_over(trial, direction);
  } else {
    trial::lay_down(trial, direction);
  }
  const double start = trial::wait_until_still(trial).since;
  double highest = 0;
  GetUpResult result;
  trial.run_until(
      [&] {
        const double height = trial.torso_height() * std::cos(trial.torso_tilt());
        highest = std::max(highest, height);
        result.is_up = trial::has_got_up(trial);
        return result.is_up || trial.core().motion_state().num_tries > 1;
      },
      kTimeout);
  result.time = trial.time() - start;
  result.cost = result.is_up ? result.time
                             : kFailed - kHeightCounts * std::clamp(highest / standing, 0.0, 1.0);
  return result;
}

GetUpCourse::Start parse_start(const std::string& name) {
  using Start = GetUpCourse::Start;
  if (name == "any") return Start::kAny;
  if (name == "belly") return Start::kBelly;
  if (name == "back") return Start::kBack;
  if (name == "left") return Start::kLeft;
  if (name == "right") return Start::kRight;
  throw ConfigError("start " + name + " is not one of any, belly, back, left, right");
}

}  // namespace nao
