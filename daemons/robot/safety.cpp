#include "daemons/robot/safety.h"

#include <algorithm>

#include "common/smooth_step.h"
#include "messages/enum_names.h"

namespace nao::robot {
namespace {

/** Roll and pitch within which the robot may get stiff, rad: Nao Devils. */
constexpr double kUprightTilt = 0.2;
/** Tilt beyond which the robot cannot sit down, rad. Chosen between Bembelbots' 0.3 rad and
 * B-Human's 45 degrees: sitting down itself tilts the torso by 0.25 rad. */
constexpr double kLimpTilt = 0.5;
/** Tilt beyond which the button is ignored, rad, since a fall may press it. */
constexpr double kButtonTilt = 0.6;
/** Time in which the stiffness rises, s: Nao Devils. */
constexpr double kStiffeningTime = 2.4;
/** Time in which the difference between the held angles and the first command vanishes, s. Chosen:
 * the difference is a few degrees. */
constexpr double kFollowTime = 0.5;
/** Least stiffness of a stiff leg. */
constexpr double kStiffLeg = 0.05;
/** Difference of stiffness that counts as none. Chosen: far above the rounding of a frame's float,
 * and far below what holds a joint. */
constexpr double kStiffnessStep = 0.01;
/** Time for which "limp" is sent to a robot that does not become limp before the program ends, s:
 * 25 frames. Chosen. */
constexpr double kLastFramesTime = 0.3;
/** Stiffness while it sits down: B-Human's of legs. */
constexpr double kSittingStiffness = 0.75;

}  // namespace

std::string to_string(Phase phase) {
  static constexpr auto kNames =
      std::to_array<const char*>({"limp", "getting stiff", "driven", "sitting down", "ended"});
  return name_in(kNames, phase);
}

std::string to_string(Cause cause) {
  static constexpr auto kNames = std::to_array<const char*>(
      {"", "it was stiff when the program connected", "the program ends",
       "the chest button was pressed", "no joint commands", "it is tilted too far",
       "the battery is low", "a motor is too hot", "a motor does not answer"});
  return name_in(kNames, cause);
}

Safety::Safety(const RobotModel& model, const LolaMap& map, double period, bool starts_itself)
    : map_(map), period_(period), starts_itself_(starts_itself), sit_down_(model) {
  for (const LegDescription& leg : model.legs()) {
    for (const int joint : leg.joints) {
      if (model.motor_of(joint) >= 0) legs_.push_back(model.motor_of(joint));
    }
  }
  held_.position.assign(static_cast<size_t>(model.num_motors()), 0);
  held_.stiffness = held_.position;
}

// Called in every frame, before the targets are sent: first the phase, then the targets that the
// phase allows.
void Safety::step(const Input& input, Targets& targets) {
  frames_without_command_ = input.command != nullptr ? 0 : frames_without_command_ + 1;
  if (is_first_) begin(input, targets);
  change_phase(input, targets);
  set_targets(input, targets);
  time_ += period_;
}

void Safety::begin(const Input& input, Targets& targets) {
  is_first_ = false;
  targets.position = input.measured.position;
  for (size_t i = 0; i < targets.stiffness.size(); ++i) {
    targets.stiffness[i] = std::clamp(input.measured.stiffness[i], 0.0, 1.0);
  }
  // After a crash the servos keep their stiffness, and the robot may be on its feet.
  if (are_legs_stiff(targets.stiffness)) {
    leave(Cause::kFoundStiff, input, targets);
    return;
  }
  // An earlier program has made it sit down: its hips continue to hold.
  for (size_t i = 0; i < targets.stiffness.size(); ++i) {
    is_seated_ = is_seated_ || (map_.seated_stiffness[i] > 0 && targets.stiffness[i] > 0);
  }
}

void Safety::change_phase(const Input& input, const Targets& targets) {
  const Press press = input.measured.tilt() > kButtonTilt ? Press::kNone : input.press;
  // A request to end remains in force in any case.
  ends_ = ends_ || input.is_ending || press == Press::kLong;
  switch (phase_) {
    case Phase::kLimp:
      if (ends_ && (is_limp(input.measured) || time_ >= kLastFramesTime)) {
        enter(Phase::kEnded);
      } else if (!ends_ && (starts_itself_ || press != Press::kNone) && may_start(input)) {
        start(input, targets);
      }
      return;
    case Phase::kStiffening:
    case Phase::kDriven: {
      // Two presses make the robot limp at once, for an emergency. All other causes make it sit
      // down first.
      const Cause cause = find_cause(input, press);
      if (press == Press::kTwice) {
        starts_itself_ = false;
        go_limp(Cause::kButton, false);
      } else if (cause != Cause::kNone) {
        leave(cause, input, targets);
      } else if (phase_ == Phase::kStiffening && time_ >= kStiffeningTime) {
        // The robot is stiff: from now on it follows the controller's commands.
        enter(Phase::kDriven);
      }
      return;
    }
    // A robot that falls while it sits down goes limp.
    case Phase::kSitting:
      if (input.measured.tilt() > kLimpTilt) {
        go_limp(Cause::kTilt, false);
      } else if (sit_down_.is_done()) {
        go_limp(cause_, true);
      }
      return;
    default:
      return;
  }
}

// The first cause that holds.
Cause Safety::find_cause(const Input& input, Press press) const {
  if (press == Press::kLong) return Cause::kButton;
  if (ends_) return Cause::kEnding;
  switch (input.fault) {
    case Fault::kBatteryLow:
      return Cause::kBatteryLow;
    case Fault::kHeat:
      return Cause::kHeat;
    case Fault::kDeadMotor:
      return Cause::kDeadMotor;
    default:
      break;
  }
  if (!has_controller()) return Cause::kLinkLost;
  // Falls of a driven robot are handled by the controller, which protects the robot and gets up.
  if (phase_ == Phase::kStiffening && input.measured.tilt() > kLimpTilt) return Cause::kTilt;
  return Cause::kNone;
}

// Upright, under control and without a fault.
bool Safety::may_start(const Input& input) const {
  return input.measured.tilt() <= kUprightTilt && has_controller() && input.fault == Fault::kNone;
}

bool Safety::are_legs_stiff(const std::vector<double>& stiffness) const {
  return std::any_of(legs_.begin(), legs_.end(), [&](int motor) {
    // The threshold is above the stiffness that a seated robot keeps.
    const auto index = static_cast<size_t>(motor);
    return stiffness[index] > std::max(kStiffLeg, map_.seated_stiffness[index] + kStiffLeg);
  });
}

bool Safety::is_limp(const Measurement& measured) const {
  for (size_t i = 0; i < measured.stiffness.size(); ++i) {
    if (measured.stiffness[i] > limp_stiffness(i) + kStiffnessStep) return false;
  }
  return true;
}

double Safety::limp_stiffness(size_t motor) const {
  return is_seated_ ? map_.seated_stiffness[motor] : 0;
}

void Safety::start(const Input& input, const Targets& targets) {
  held_.position = input.measured.position;
  held_.stiffness = targets.stiffness;
  is_seated_ = false;
  enter(Phase::kStiffening);
}

void Safety::leave(Cause cause, const Input& input, const Targets& targets) {
  // A robot that lies, or whose legs are already limp, cannot sit down.
  if (input.measured.tilt() > kLimpTilt || !are_legs_stiff(targets.stiffness)) {
    go_limp(cause, false);
    return;
  }
  cause_ = cause;
  sit_down_.begin(targets.position);
  enter(Phase::kSitting);
}

void Safety::go_limp(Cause cause, bool is_seated) {
  cause_ = cause;
  is_seated_ = is_seated;
  enter(Phase::kLimp);
}

void Safety::enter(Phase phase) {
  phase_ = phase;
  time_ = 0;
  has_followed_ = false;
}

void Safety::set_targets(const Input& input, Targets& targets) {
  switch (phase_) {
    case Phase::kStiffening:
      targets.position = held_.position;
      for (size_t i = 0; i < targets.stiffness.size(); ++i) {
        // The targets are the angles at which the joints were found, so that the stiffness rises
        // without motion.
        targets.stiffness[i] = std::max(held_.stiffness[i], smooth_step(time_ / kStiffeningTime));
      }
      return;
    case Phase::kDriven:
      follow_command(input, targets);
      return;
    case Phase::kSitting:
      sit_down_.step(period_, targets.position);
      for (double& stiffness : targets.stiffness)
        stiffness = std::max(stiffness, kSittingStiffness);
      return;
    default:
      // Limp: targets follow the joints, so that nothing jumps when they become stiff again. A
      // seated robot keeps some stiffness in its hips.
      for (size_t i = 0; i < targets.position.size(); ++i) {
        targets.stiffness[i] = limp_stiffness(i);
        if (targets.stiffness[i] == 0) targets.position[i] = input.measured.position[i];
      }
  }
}

void Safety::follow_command(const Input& input, Targets& targets) {
  // In the first frame of the phase the command is still one that answers an earlier, limp robot.
  if (input.command == nullptr || time_ == 0) return;
  if (!has_followed_) {
    has_followed_ = true;
    follow_time_ = 0;
    for (size_t i = 0; i < targets.position.size(); ++i) {
      held_.position[i] = targets.position[i] - input.command->position[i];
    }
  }
  follow_time_ += period_;
  // The offset between held angles and the first command fades out.
  const double left = 1 - smooth_step(follow_time_ / kFollowTime);
  for (size_t i = 0; i < targets.position.size(); ++i) {
    targets.position[i] = input.command->position[i] + left * held_.position[i];
    targets.stiffness[i] = std::clamp(input.command->stiffness[i], 0.0, 1.0);
  }
}

}  // namespace nao::robot
