#include "tools/transition-tuner/get_up_course.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "tools/nao-trial/lying_start.h"

namespace nao {
namespace {

constexpr double kTimeout = 14;  // s for one try
constexpr double kSpread = 0.6;  // rad, either side of how it shall lie

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

/** Sums over the ticks of a try. */
class Effort {
 public:
  explicit Effort(ClosedLoop& trial) : trial_(trial), last_(trial.torso_in_world().linear()) {}

  void add_tick() {
    const sim::SensorReadings& readings = trial_.world().sensors(0);
    double greatest = 0;
    for (int motor = 0; motor < trial_.model().num_motors(); ++motor) {
      greatest = std::max(greatest, std::abs(readings.torque[motor]) /
                                        trial_.model().motor_joint(motor).max_torque);
    }
    load_ += greatest;
    // Angular velocity from the rotation since the last tick: exact, without a sensor's noise.
    const Eigen::Matrix3d torso = trial_.torso_in_world().linear();
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(torso * last_.transpose()));
    const Eigen::Vector3d rate = turn.angle() / trial_.period() * turn.axis();
    if (num_ticks_ > 0) {
      squared_acceleration_ += ((rate - last_rate_) / trial_.period()).squaredNorm();
    }
    last_ = torso;
    last_rate_ = rate;
    ++num_ticks_;
  }

  double load() const { return load_ / std::max(1, num_ticks_); }
  double shaking() const { return std::sqrt(squared_acceleration_ / std::max(1, num_ticks_)); }

 private:
  ClosedLoop& trial_;
  Eigen::Matrix3d last_;
  Eigen::Vector3d last_rate_ = Eigen::Vector3d::Zero();
  double load_ = 0;
  double squared_acceleration_ = 0;
  int num_ticks_ = 0;
};

}  // namespace

GetUpResult GetUpCourse::run(ClosedLoopOptions options, const motion::TransitionGraph& transitions,
                             uint64_t seed) const {
  options.motion.transitions = transitions;
  ClosedLoop trial(options, seed);
  const double standing = trial.model().references().heights.standing;
  const double spread = start_ == Start::kAny ? M_PI : kSpread;
  const double direction = direction_of(start_) + trial.random(-spread, spread);
  trial.run(0.5);
  if (seed % 2 == 1) {
    trial::knock_over(trial, direction);
  } else {
    trial::lay_down(trial, direction);
  }
  const double start = trial::wait_until_still(trial).since;
  Effort effort(trial);
  GetUpResult result;
  trial.run_until(
      [&] {
        effort.add_tick();
        const double height = trial.torso_height() * std::cos(trial.torso_tilt());
        result.height = std::clamp(height / standing, result.height, 1.0);
        result.is_up = trial::has_got_up(trial);
        return result.is_up || trial.core().motion_state().num_tries > 1;
      },
      kTimeout);
  result.time = trial.time() - start;
  result.load = effort.load();
  result.shaking = effort.shaking();
  result.is_up = result.is_up && trial::keeps_standing(trial);
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
