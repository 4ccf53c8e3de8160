#pragma once

#include <string>
#include <vector>

#include "daemons/robot/chest_button.h"
#include "daemons/robot/health_monitor.h"
#include "daemons/robot/measurement.h"
#include "daemons/robot/sit_down.h"
#include "daemons/robot/targets.h"
#include "lola/lola_map.h"
#include "robot_model/robot_model.h"

namespace nao::robot {

/** State of the robot's servos. */
enum class Phase {
  /** Without torque, targets at the measured angles. A seated robot's hips keep a little. */
  kLimp,
  /** Holds the angles that it had, with rising stiffness. */
  kStiffening,
  /** Follows joint commands. */
  kDriven,
  /** Goes to the posture that needs no torque. */
  kSitting,
  /** Limp; nothing follows. */
  kEnded,
};

/** Why the robot sits down, or went limp. */
enum class Cause {
  kNone,
  kFoundStiff,
  kEnding,
  kButton,
  kLinkLost,
  kTilt,
  kBatteryLow,
  kHeat,
  kDeadMotor
};

std::string to_string(Phase phase);
/** In words, such as "no joint commands". */
std::string to_string(Cause cause);

/** Decides when the robot may be stiff. A state machine without clock: every step is one frame.
 *
 * It starts limp (a robot that is found stiff sits down first). The chest button starts it: pressed
 * once, or twice, which also makes a stiff robot limp; pressed for 3 s it sits down and ends. It
 * gets stiff only if it is upright, a controller is there, and nothing is at fault. Then it obeys
 * the controller until that falls silent, the program ends, or battery or motors are at fault. Then
 * it sits down, or goes limp at once if it is tilted too far to sit.
 *
 * Sources of the rules: B-Human, Nao Devils, rUNSWift, Bembelbots (docs/real-robot.md). */
class Safety {
 public:
  struct Input {
    const Measurement& measured;
    /** New targets from the controller, for all motors; nullptr: none in this frame. */
    const Targets* command = nullptr;
    Press press = Press::kNone;
    Fault fault = Fault::kNone;
    /** The program is to end. */
    bool is_ending = false;
  };

  /** @param starts_itself  Gets stiff without the button whenever it may, for simulators.
   * @param model, map  Must outlive this. @param period  Period of frames, s. */
  Safety(const RobotModel& model, const LolaMap& map, double period, bool starts_itself);

  /** One frame. @param targets  Those sent last; gets those to be sent, still without limit on
   * their speed. Allocates nothing. */
  void step(const Input& input, Targets& targets);

  Phase phase() const { return phase_; }
  /** Why the robot last sat down or went limp. */
  Cause cause() const { return cause_; }
  /** Joint commands have come in the last frames. */
  bool has_controller() const { return frames_without_command_ < kLostFrames; }

  /** Frames without a command after which the controller counts as lost: Nao Devils; B-Human takes
   * 100 ms. */
  static constexpr int kLostFrames = 10;

 private:
  void begin(const Input& input, Targets& targets);
  void change_phase(const Input& input, const Targets& targets);
  /** Reason not to stay stiff; none if there is none. @param press  None if it is ignored. */
  Cause find_cause(const Input& input, Press press) const;
  bool may_start(const Input& input) const;
  /** The servos have the stiffness of a limp robot. */
  bool is_limp(const Measurement& measured) const;
  /** Stiffness of a motor of a limp robot. */
  double limp_stiffness(size_t motor) const;
  bool are_legs_stiff(const std::vector<double>& stiffness) const;
  void start(const Input& input, const Targets& targets);
  /** Sits down, or goes limp if it cannot. */
  void leave(Cause cause, const Input& input, const Targets& targets);
  void go_limp(Cause cause, bool is_seated);
  void enter(Phase phase);
  void set_targets(const Input& input, Targets& targets);
  void follow_command(const Input& input, Targets& targets);

  const LolaMap& map_;
  double period_;
  bool starts_itself_;
  SitDown sit_down_;
  std::vector<int> legs_;
  Phase phase_ = Phase::kLimp;
  Cause cause_ = Cause::kNone;
  bool is_first_ = true;
  bool is_seated_ = false;
  /** Ends when the servos have become limp, or have been told so for 0.3 s. */
  bool ends_ = false;
  /** Time in the current phase, s. */
  double time_ = 0;
  int frames_without_command_ = kLostFrames;
  /** Targets at the start of kStiffening; in kDriven, the difference between the first command and
   * the targets held before it. */
  Targets held_;
  bool has_followed_ = false;
  /** Time since the first command that is followed, s. */
  double follow_time_ = 0;
};

}  // namespace nao::robot
