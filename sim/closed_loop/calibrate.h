#pragma once

#include <cstdint>

#include "calibration/calibration.h"
#include "sim/closed_loop/closed_loop.h"

namespace nao {

/** Calibrates a simulated robot as `nao calibrate` does a robot on the bus: the robot that the
 * options and the seed draw, in a separate world, on the same floor. A robot that cannot complete
 * its moves is calibrated by those that it completed.
 * @param num_stations  Directions in which it stands, 1 to 8. */
Calibration calibrate(const ClosedLoopOptions& options, uint64_t seed, int num_stations);

}  // namespace nao
