#include "daemons/motion/walk/step_timing.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/walk/zmp_control.h"

namespace nao::motion {

double adapt_step_duration(const Gait& gait, const LateralDcm& dcm, double omega, double time,
                           double duration) {
  const double gain = gait.feedback.timing_gain;
  // A gain of 0 switches the adaptation off.
  if (gain <= 0 || duration - time < kMinHorizon) return duration;
  const Gait::Timing& timing = gait.timing;
  // A DCM that moves back over the support foot does not reach the end point: step late. One that
  // is beyond it: step now.
  double ideal = timing.max_step_duration;
  if (dcm.now > 0 && dcm.end > dcm.now) ideal = time + std::log(dcm.end / dcm.now) / omega;
  if (dcm.now > 0 && dcm.end <= dcm.now) ideal = time;
  // A fraction of the correction, so that noise of the DCM does not become noise of the timing.
  const double adapted = timing.step_duration + gain * (ideal - timing.step_duration);
  const double clamped = std::clamp(adapted, timing.min_step_duration, timing.max_step_duration);
  return std::max(clamped, time + kMinHorizon);
}

SwingTiming time_swing(const Gait& gait, double time, double duration) {
  // The step begins and ends with half of the double support: the swing is between them.
  const double half = gait.timing.double_support_duration / 2;
  if (time < half) return {};
  const double end = duration - half;
  SwingTiming swing;
  swing.is_swinging = true;
  swing.phase = (time - half) / (end - half);
  swing.remaining = half + gait.swing.arrival_fraction * (end - half) - time;
  return swing;
}

}  // namespace nao::motion
