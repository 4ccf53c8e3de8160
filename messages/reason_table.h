#pragma once

#include <array>
#include <string_view>

namespace nao {

/** One reason for which a command is refused, interrupted or fails, or a remark about its end. */
struct ReasonEntry {
  /** Lower-case words with hyphens. Stable: clients translate by it. */
  std::string_view code;
  /** Names of the arguments, separated by commas; for the documentation. */
  std::string_view arguments;
  /** English; "{0}", "{1}", ... stand for the arguments. */
  std::string_view sentence;
};

// clang-format off
/** All reasons. lcmtypes/README.md has the same table; a test compares the two. */
inline constexpr auto kReasons = std::to_array<ReasonEntry>({
    // Sender of the command.
    {"source-missing", "", "The command has no source; set it to the sender's name."},
    {"source-too-long", "length, limit", "The source has {0} characters; at most {1} are allowed."},
    {"command-id-zero", "", "The command id is 0, which means none; count from 1."},
    // Values of the command.
    {"speed-out-of-range", "speed", "Speed {0} is outside (0, 1]."},
    {"strength-out-of-range", "strength", "Strength {0} is outside (0, 1]."},
    {"velocity-not-finite", "", "vx, vy and wz must be finite numbers."},
    {"goal-not-finite", "", "x, y and theta of the goal must be finite numbers."},
    {"ball-not-finite", "", "The coordinates of the ball must be finite numbers, or NaN for none."},
    {"posture-unknown", "posture, known postures", "The robot has no posture {0}; it has {1}."},
    {"action-unknown", "action, known actions", "The robot has no action {0}; it has {1}."},
    {"joints-missing", "", "The command names no joint."},
    {"joint-unknown", "joint", "The robot has no joint {0}."},
    {"joint-without-motor", "joint", "Joint {0} has no motor of its own; another joint drives it."},
    {"joint-repeated", "joint", "Joint {0} is listed more than once."},
    {"joint-missing", "joint", "Joint {0} is missing; all joints must be listed."},
    {"joint-lists-unequal", "joints, quantity, values", "There are {0} joint names, but {2} values of {1}."},
    {"joint-value-not-finite", "joint, quantity", "The {1} of joint {0} is not a finite number."},
    {"joint-value-out-of-range", "joint, quantity, value, lower, upper", "The {1} of joint {0} is {2}, outside [{3}, {4}]."},
    // Mode of the robot.
    {"no-robot", "", "There is no robot: no sensor data arrive."},
    {"robot-relaxed", "", "The motors are relaxed; wake the robot up first."},
    {"robot-falling", "", "The robot is falling."},
    {"robot-fallen", "", "The robot lies on the ground; let it get up first."},
    {"robot-getting-up", "", "The robot is getting up; wait until it stands."},
    // Joint changes.
    {"self-collision", "joint, first link, second link, degrees", "{0} would make {1} collide with {2}; it can turn by at most {3} degrees."},
    {"tipping-forward", "joint, degrees", "{0} would tip the robot over forwards; it can turn by at most {1} degrees."},
    {"tipping-backward", "joint, degrees", "{0} would tip the robot over backwards; it can turn by at most {1} degrees."},
    {"tipping-left", "joint, degrees", "{0} would tip the robot over to the left; it can turn by at most {1} degrees."},
    {"tipping-right", "joint, degrees", "{0} would tip the robot over to the right; it can turn by at most {1} degrees."},
    {"clipped-to-limits", "joints", "Clipped to the joint limits: {0}."},
    // Walks.
    {"no-gait", "robot", "The robot {0} has no gait."},
    {"not-walking", "", "The robot does not walk."},
    {"legs-too-soft", "stiffness in percent, limit in percent", "The legs are too soft to walk: their stiffness is {0} %, more than {1} % is needed."},
    {"not-upright", "", "The robot does not stand upright."},
    {"no-foot-contact", "", "No foot carries weight; put the robot on the ground."},
    {"no-foot-force-sensors", "", "The robot has no foot force sensors, so its contact with the ground is unknown."},
    {"balance-lost", "", "The robot lost its balance."},
    {"robot-lifted", "", "The robot was lifted off the ground."},
    {"walk-command-timeout", "seconds", "The walk ended: no walk command for {0} s."},
    {"goal-timeout", "metres", "The goal was not reached in time; {0} m remain."},
    // Kicks and other actions.
    {"no-kick", "robot", "The robot {0} has no kick."},
    {"ball-out-of-reach", "least x, greatest x, least y, greatest y", "The ball is out of reach: it must be {0} to {1} m ahead and {2} to {3} m to the left."},
    {"kick-missed", "", "The ball could not be reached in time."},
    {"walk-ended-before-kick", "", "The walk ended before the kick."},
    {"action-without-motion", "action", "The robot has no motion for the action {0}."},
    {"action-needs-state", "action, needed state, present state", "The action {0} starts from {1}; the robot is in the state {2}."},
    // Postures and getting up.
    {"no-path", "state, posture", "The transition graph has no path from {0} to {1}."},
    {"path-too-long", "posture, transitions", "The robot did not reach {0} after {1} transitions."},
    {"posture-not-reached", "joint, degrees, posture", "{0} stays {1} degrees away from {2}; something blocks it."},
    {"get-up-failed", "tries", "The robot did not get up in {0} tries; it needs help."},
    {"robot-fell", "", "The robot fell."},
    // Replaced by something newer.
    {"replaced", "command", "Replaced by a newer command: {0}."},
    {"replaced-by-motion", "motion", "Replaced by the robot's own motion: {0}."},
    {"replaced-before-start", "", "A newer command replaced it before it started."},
});
// clang-format on

/** @return Position in kReasons; kReasons.size() if there is no such code. */
constexpr size_t find_reason_entry(std::string_view code) {
  size_t index = 0;
  while (index < kReasons.size() && kReasons[index].code != code) ++index;
  return index;
}

}  // namespace nao
