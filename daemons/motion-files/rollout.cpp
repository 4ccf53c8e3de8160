#include "daemons/motion-files/rollout.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace nao {
namespace {

using motion::ActionScript;
using motion::MotionFault;

// Time before the command, in which estimates and contacts settle, s; and time after its end, in
// which a robot that has lost its balance falls, s.
constexpr double kSettlingTime = 1.0;
constexpr double kHoldingTime = 1.5;
// Time allowed beyond the motion's own duration, s: the path to the start posture, and obstacles on
// it.
constexpr double kPatience = 20;
// Self-contact of up to this duration, s, does not count: one control period.
constexpr double kBrush = 0.01;
// A joint is blocked if it stays farther than this from its target, rad, for this long, s. Chosen
// with nao-trial: hand-made motions of loaded and fast joints stay beyond 0.2 rad for 0.25 s.
constexpr double kBlockedError = 0.2;
constexpr double kBlockedTime = 0.5;
// Joints with less stiffness yield on purpose.
constexpr double kYieldingStiffness = 0.6;
// Tilt of the torso at which a robot on its feet, and one that sits, has fallen, rad.
constexpr double kFallenTilt = 0.7;
constexpr double kFallenTiltSitting = 1.0;

/** Watches one simulated motion. */
class Watch {
 public:
  Watch(ClosedLoop& trial, double fallen_tilt)
      : trial_(trial), fallen_tilt_(fallen_tilt), blocked_time_(trial.model().num_motors(), 0) {}

  /** Before the motion: links that touch now may touch during it, such as the hands of a robot that
   * sits its shins. */
  void look_before() {
    for (const sim::Contact& contact : trial_.world().contacts()) {
      if (is_self_contact(contact)) touching_.insert(links_of(contact));
    }
  }

  /** To be called after every tick. */
  void look() {
    const int keyframe = trial_.core().motion_state().keyframe;
    if (keyframe >= 0) keyframe_ = keyframe;
    if (fault_) return;
    const Mode mode = trial_.core().motion_state().mode;
    if (trial_.torso_tilt() > fallen_tilt_ || mode == Mode::kFalling || mode == Mode::kFallen) {
      note(Reason("motion-fall"));
      return;
    }
    look_for_blocked_joints();
    for (const sim::Contact& contact : trial_.world().contacts()) {
      if (!is_self_contact(contact) || touching_.contains(links_of(contact))) continue;
      contact_time_ += trial_.period();
      if (contact_time_ <= kBrush) continue;
      const auto& links = trial_.model().links();
      note(Reason("motion-self-contact", {links[contact.a.link].name, links[contact.b.link].name}));
      return;
    }
  }

  void note(Reason reason) {
    if (!fault_) fault_ = MotionFault{std::max(keyframe_, 0), std::move(reason)};
  }

  const std::optional<MotionFault>& fault() const { return fault_; }

 private:
  static bool is_self_contact(const sim::Contact& contact) {
    return contact.a.kind == sim::Surface::Kind::kRobot &&
           contact.b.kind == sim::Surface::Kind::kRobot;
  }
  /** A joint may be blocked by the floor, which is not a self-contact, or by a link that touched
   * before. */
  void look_for_blocked_joints() {
    const sim::MotorTargets& targets = trial_.world().targets(0);
    const Eigen::VectorXd error = targets.position - trial_.world().sensors(0).position;
    for (Eigen::Index motor = 0; motor < error.size(); ++motor) {
      const bool is_stiff = targets.stiffness[motor] >= kYieldingStiffness;
      const bool is_away = is_stiff && std::abs(error[motor]) > kBlockedError;
      blocked_time_[motor] = is_away ? blocked_time_[motor] + trial_.period() : 0;
      if (blocked_time_[motor] <= kBlockedTime) continue;
      note(Reason("motion-joint-blocked", {trial_.model().motor_names()[motor]}));
    }
  }
  static std::pair<int, int> links_of(const sim::Contact& contact) {
    return std::minmax({contact.a.link, contact.b.link});
  }

  ClosedLoop& trial_;
  double fallen_tilt_;
  /** Links that touched at the start. */
  std::set<std::pair<int, int>> touching_;
  int keyframe_ = -1;
  double contact_time_ = 0;
  /** Time for which each motor has been away from its target, s. */
  std::vector<double> blocked_time_;
  std::optional<MotionFault> fault_;
};

/** A robot that lies cannot fall. */
double fallen_tilt(const RobotModel& model, const ActionScript& script) {
  const Posture* start = model.find_posture(script.start);
  if (start != nullptr && start->is_lying()) return M_PI;
  return motion::starts_on_feet(model, script) ? kFallenTilt : kFallenTiltSitting;
}

}  // namespace

std::optional<MotionFault> roll_out(const ClosedLoopOptions& options, uint64_t seed,
                                    const ActionScript& script, const RolloutEnd& end) {
  ClosedLoopOptions with_start = options;
  with_start.posture = script.start;
  with_start.motion.gets_up = false;
  ClosedLoop trial(with_start, seed);
  trial.teach(script);
  Watch watch(trial, fallen_tilt(trial.model(), script));
  trial.on_tick([&watch] { watch.look_before(); });
  trial.run(kSettlingTime);
  trial.on_tick([&watch] { watch.look(); });
  const int64_t id = trial.send_action(script.sequence.name);
  const double begin = trial.time();
  const double timeout = kPatience + 2 * script.num_repetitions * script.sequence.duration();
  const auto is_cancelled = [&end] { return end.is_cancelled != nullptr && *end.is_cancelled; };
  bool is_stopped = false;
  size_t next = 0;
  std::optional<CommandResult> result;
  trial.run_until(
      [&] {
        if (!is_stopped && trial.time() - begin >= end.stop_time) {
          trial.send({"", 0, StopCommand{}});
          is_stopped = true;
        }
        for (; next < trial.results().size(); ++next) {
          const CommandResult& candidate = trial.results()[next];
          if (candidate.id == id && candidate.status != ResultStatus::kAccepted) result = candidate;
        }
        return result.has_value() || watch.fault().has_value() || is_cancelled();
      },
      timeout);
  if (!watch.fault() && !is_cancelled()) trial.run(kHoldingTime);
  if (watch.fault()) return watch.fault();
  const bool is_done = result && (result->status == ResultStatus::kDone ||
                                  (is_stopped && result->status == ResultStatus::kInterrupted));
  if (!is_done) {
    watch.note(Reason("motion-blocked",
                      {result ? to_sentence(result->reason) : "it does not come to its end."}));
  }
  return watch.fault();
}

}  // namespace nao
