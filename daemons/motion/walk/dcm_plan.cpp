#include "daemons/motion/walk/dcm_plan.h"

#include "daemons/motion/walk/pendulum.h"

namespace nao::motion {

DcmPlan plan_dcm(const std::vector<Eigen::Vector2d>& zmps, const Eigen::Vector2d& final_dcm,
                 double omega, double step_duration) {
  DcmPlan plan;
  plan.end = final_dcm;
  // Backward recursion: negative time in the DCM's solution xi(t) = p + e^(omega t) (xi(0) - p).
  // After the loop plan.end is the DCM at the end of the present step.
  for (size_t i = zmps.size() - 1; i > 0; --i) {
    plan.end = advance_dcm(plan.end, zmps[i], omega, -step_duration);
  }
  plan.start = advance_dcm(plan.end, zmps[0], omega, -step_duration);
  return plan;
}

}  // namespace nao::motion
