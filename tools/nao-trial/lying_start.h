#pragma once

#include <string>

#include "sim/closed_loop/closed_loop.h"

namespace nao::trial {

/** Pushes the standing robot until it falls.
 * @param direction  Direction of the push, rad: 0 forward, pi / 2 to the left.
 * @return false if it has not fallen 5 s after the second push, which is twice as strong. */
bool knock_over(ClosedLoop& trial, double direction);

/** Places the robot lying, with joint angles up to 0.5 rad from StandInit, and starts a new motion
 * core there: the placement is a jump that the sensors of a running core could not explain.
 * @param side  Rotation about its long axis, rad: 0 on the belly, pi on the back. */
void lay_down(ClosedLoop& trial, double side);

/** Lying pose of the robot at rest. */
struct LyingStill {
  /** "belly", "back", "left" or "right". */
  std::string side;
  /** Time at which it came to rest, s since the start of the trial. */
  double since = 0;
};

/** Waits until the robot is at rest, at most 3 s: the torso's angular velocity stays below 0.1
 * rad/s for 0.1 s. A robot that begins to get up earlier counts as at rest. */
LyingStill wait_until_still(ClosedLoop& trial);

/** True if the robot stands in StandInit and its motion state reports it. */
bool has_got_up(ClosedLoop& trial);

/** Runs for 2 s. @return false as soon as the robot topples: it had got up off its balance. */
bool keeps_standing(ClosedLoop& trial);

}  // namespace nao::trial
