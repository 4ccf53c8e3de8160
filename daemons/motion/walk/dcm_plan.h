#pragma once

#include <Eigen/Core>
#include <vector>

namespace nao::motion {

/** Planned DCM at the start and at the end of the present step, m. */
struct DcmPlan {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
};

/** Plans the DCM of a sequence of steps backwards from its last value.
 *
 * While the ZMP is held at p_i in step i, xi_i(end) = p_i + e^(omega T) (xi_i(start) - p_i), and
 * xi_i(end) = xi_(i+1)(start). Solved for the start, from the last step to the first. The error of
 * the assumed last value decays by e^(-omega T) in each step (0.22 for the NAO).
 *
 * Source: J. Englsberger et al., IEEE T-RO 31(2), 2015; here with one constant ZMP in each step.
 *
 * @param zmps           Nominal ZMP in each step, the present one first, m; not empty.
 * @param final_dcm      At the end of the last step, m.
 * @param omega          1/s. @param step_duration  s. */
DcmPlan plan_dcm(const std::vector<Eigen::Vector2d>& zmps, const Eigen::Vector2d& final_dcm,
                 double omega, double step_duration);

}  // namespace nao::motion
