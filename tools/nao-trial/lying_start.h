#pragma once

#include <string>

#include "closed_loop/closed_loop.h"

namespace nao::trial {

/** Pushes the robot that stands until it falls.
 * @param direction  To where, rad: 0 ahead, pi / 2 to the left.
 * @return false if it has not fallen after 5 s. */
bool knock_over(ClosedLoop& trial, double direction);

/** Lays the robot down with joints up to 0.5 rad from StandInit, and switches its mind on there:
 * one that is carried feels it, but this one is put there by magic.
 * @param side  What it lies on, rad about its long axis: 0 belly, pi back. */
void lay_down(ClosedLoop& trial, double side);

/** How the robot lies once it has come to rest. */
struct LyingStill {
  /** "belly", "back", "left" or "right". */
  std::string side;
  /** When it came to rest, s since the start of the trial. */
  double since = 0;
};

/** Lets the robot come to rest, 3 s at most: its torso turns at less than 0.1 rad/s for 0.1 s. One
 * that begins to get up before has lain still for long enough. */
LyingStill wait_until_still(ClosedLoop& trial);

/** Whether the robot stands in StandInit and says so. */
bool has_got_up(ClosedLoop& trial);

}  // namespace nao::trial
