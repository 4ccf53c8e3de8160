#pragma once

#include <array>
#include <string_view>

namespace nao {

/** One reason for which a command is refused, interrupted or fails, or a remark about its end. */
struct ReasonEntry {
  /** Lower-case words with hyphens. Stable: clients translate by it. */
  std::string_view code;
  /** Names of the arguments, separated by commas. */
  std::string_view arguments;
  /** English; "{0}", "{1}", ... stand for the arguments. */
  std::string_view sentence;
};

// clang-format off
/** All reasons of the robot's programs. */
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
    {"joint-carries-robot", "joint", "{0} carries the robot; let it sit or lie down before you relax it."},
    // Walks.
    {"no-gait", "robot", "The robot {0} has no gait."},
    {"not-walking", "", "The robot does not walk."},
    {"legs-too-soft", "stiffness in percent, limit in percent", "The legs are too soft to walk: their stiffness is {0} %, more than {1} % is needed."},
    {"not-upright", "", "The robot does not stand upright."},
    {"orientation-doubtful", "degrees", "Roll and pitch differ by {0} degrees from accelerometer and gyroscope: the robot does not walk; check its inertial unit."},
    {"no-foot-contact", "", "No foot carries weight; put the robot on the ground."},
    {"balance-lost", "", "The robot lost its balance."},
    {"robot-lifted", "", "The robot was lifted off the ground."},
    {"walk-command-timeout", "seconds", "The walk ended: no walk command for {0} s."},
    {"goal-timeout", "metres", "The goal was not reached in time; {0} m remain."},
    // Policies.
    {"policy-unusable", "policy, fault", "The policy {0} cannot be used: {1}."},
    {"policy-stopped", "policy, fault", "The policy {0} was stopped: {1}."},
    // Kicks and other actions.
    {"no-kick", "robot", "The robot {0} has no kick."},
    {"ball-out-of-reach", "least x, greatest x, least y, greatest y", "The ball is out of reach: it must be {0} to {1} m ahead and {2} to {3} m to the left."},
    {"kick-missed", "", "The kick did not move the ball."},
    {"kick-direction", "degrees", "The ball went {0} degrees beside the kick's direction, to the left if above 0."},
    {"kick-unobserved", "", "Nothing tells whether the kick moved the ball."},
    {"walk-ended-before-kick", "", "The walk ended before the kick."},
    {"action-without-motion", "action", "The robot has no motion for the action {0}."},
    {"action-needs-state", "action, needed state, present state", "The action {0} starts from {1}; the robot is in the state {2}."},
    // Taught motions.
    {"motion-name-invalid", "name", "{0} is not a name of a motion; use 1 to 40 letters, digits, - and _."},
    {"motion-name-in-use", "name", "A motion {0} is saved already."},
    {"action-name-in-use", "name", "{0} is an action of the robot's own."},
    {"motion-unknown", "name", "No motion {0} is saved."},
    {"motion-malformed", "fault", "The motion cannot be read: {0}."},
    {"motion-keyframe-count", "keyframes, limit", "The motion has {0} keyframes; 1 to {1} are allowed."},
    {"motion-value-out-of-range", "quantity, value, lower, upper", "The {0} is {1}, outside [{2}, {3}]."},
    {"motion-too-long", "seconds, limit", "The motion lasts {0} s; at most {1} s are allowed."},
    {"too-many-motions", "limit", "{0} motions are saved already; delete one."},
    {"motion-beyond-limit", "joint, degrees", "{0} is {1} degrees beyond its limit."},
    {"motion-too-fast", "joint, seconds", "{0} needs at least {1} s to this keyframe."},
    {"motion-self-contact", "first link, second link", "{0} would touch {1}."},
    {"motion-fall", "", "The robot would fall."},
    {"motion-joint-blocked", "joint", "{0} would be blocked and not follow the motion."},
    {"motion-blocked", "fault", "The robot would not complete the motion: {0}"},
    {"motion-not-saved", "fault", "The motion could not be saved: {0}."},
    // Postures and getting up.
    {"no-path", "state, posture", "The transition graph has no path from {0} to {1}."},
    {"path-too-long", "posture, transitions", "The robot did not reach {0} after {1} transitions."},
    {"posture-not-reached", "joint, degrees, posture", "{0} stays {1} degrees away from {2}; something blocks it."},
    {"get-up-failed", "tries", "The robot did not get up in {0} tries; it needs help."},
    {"robot-fell", "", "The robot fell."},
    // Speech.
    {"speech-operation-unknown", "operation", "The speech operation {0} is none of 0 (say), 1 (stop) and 2 (say after)."},
    {"text-missing", "", "There is no text to speak."},
    {"text-too-long", "bytes, limit", "The text has {0} bytes; at most {1} are allowed."},
    {"text-not-unicode", "byte", "The text is not valid UTF-8, from byte {0} on."},
    {"text-control-character", "character", "The text has the control character {0}; remove it."},
    {"text-not-speakable", "language", "Nothing of the text can be spoken in the language {0}."},
    {"language-unknown", "language, known languages", "The language {0} cannot be spoken; there are {1}."},
    {"volume-out-of-range", "volume", "Volume {0} is outside [0, 1]."},
    {"rate-out-of-range", "rate, lower, upper", "Speaking rate {0} is outside [{1}, {2}]."},
    {"speech-queue-full", "texts", "{0} texts wait to be spoken already."},
    {"speech-stopped", "", "The speech was stopped."},
    {"speech-failed", "language", "The synthesizer failed in the language {0}."},
    // Behaviors.
    {"behavior-unknown", "behavior", "The behavior {0} is none of 0 (none) to 6 (auto)."},
    {"role-unknown", "role", "The role {0} is none of 0 (none) to 3 (keeper)."},
    {"target-out-of-range", "metres", "The target must be two numbers within {0} m."},
    {"behavior-unavailable", "behavior", "This robot does not have the behavior {0}."},
    {"play-command-timeout", "seconds", "The behavior ended: no play command for {0} s."},
    {"play-stopped", "", "The behavior was stopped."},
    {"vision-unavailable", "", "No images are analysed; nao-vision or the camera does not answer."},
    {"image-unusable", "status", "The camera's images cannot be used: {0}."},
    {"ball-not-in-sight", "", "The ball is not in sight; the robot looks for it."},
    {"ball-not-found", "seconds", "The ball was not found in {0} s."},
    {"ball-out", "", "The ball has left the field."},
    // Matches.
    {"match-operation-unknown", "operation", "The match operation {0} is none of 0 (start) to 8 (new match)."},
    {"match-team-unknown", "team", "There is no team {0}; there are 0 and 1."},
    {"match-robot-unknown", "robot, known robots", "The robot {0} does not take part in the match; {1} do."},
    {"match-by-game-controller", "", "The GameController decides in this match."},
    {"match-operation-too-late", "operation, phase", "The match operation {0} is not possible in the phase {1}."},
    {"match-not-played", "", "No match is being played; nao-referee does not answer."},
    {"match-penalty", "penalty", "The robot has a penalty: {0}."},
    {"play-waits-for-release", "",
     "A person has driven the robot: it plays by itself again when they release control, or with nao play auto."},
    // Lights.
    {"lights-missing", "", "The command names no light."},
    {"light-unknown", "light, known lights", "The robot has no light {0}; it has {1}."},
    {"light-color-out-of-range", "light", "The color of the light {0} must be three numbers from 0 to 1."},
    {"light-duration-out-of-range", "seconds", "The duration {0} s must be 0 or more."},
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
