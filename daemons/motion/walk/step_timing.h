#pragma once

#include "daemons/motion/walk/gait.h"

namespace nao::motion {

/** Lateral motion of the DCM in single support, from the nominal ZMP of the support foot towards
 * the swing foot, m. */
struct LateralDcm {
  double now = 0;
  /** Planned, at touchdown. */
  double end = 0;
};

/** Duration of the present step, s, adapted to the DCM.
 *
 * The DCM moves away from the ZMP exponentially, d(t) = d(0) e^(omega t). It reaches the planned
 * end point after log(end / now) / omega; then the foot must land. The fraction timing_gain of the
 * difference from the nominal duration is applied, within [min, max]_step_duration.
 *
 * @param time  Elapsed in the step, s. @param duration  Present duration, s.
 * @param omega  1/s. @return `duration` where the step ends in less than kMinHorizon. */
double adapt_step_duration(const Gait& gait, const LateralDcm& dcm, double omega, double time,
                           double duration);

/** Elapsed fraction and remaining time of the swing, s. */
struct SwingTiming {
  double phase = 0;
  double remaining = 0;
  /** False while both feet are planned to carry weight at the beginning of the step. */
  bool is_swinging = false;
};

/** Timing of the swing within a step. The foot is above its foothold after arrival_fraction. */
SwingTiming time_swing(const Gait& gait, double time, double duration);

}  // namespace nao::motion
