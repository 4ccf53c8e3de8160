#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace nao::sim {

/** Distributes the load on one foot over its force sensors, by the sensors' positions in the sole.
 *
 * The fractions are not negative and sum to 1, and their center is the center of pressure, as long
 * as that lies within the sensors' convex hull; beyond, it is a point near it on the hull's edge.
 *
 * - Four sensors listed as front left, front right, rear left, rear right: bilinear interpolation.
 * - Any other number or order: fractions that are a linear function of the position, as the
 * pressure under a rigid sole on uniformly elastic ground is (Winkler foundation); that is also the
 *   distribution with the least sum of squares. Sensors for which it is negative are unloaded, the
 *   most negative one first, and the others share the load in the same way.
 * - No sensor: nothing. */
class FootLoad {
 public:
  /** @param positions  Positions of the sensors in the sole's frame (x ahead, y left), m. */
  explicit FootLoad(std::vector<Eigen::Vector2d> positions);

  /** Fraction of the load on each sensor, in their order. Allocates nothing.
   * @param center_of_pressure  In the sole's frame, m. @return Valid until the next call. */
  const std::vector<double>& distribute(const Eigen::Vector2d& center_of_pressure);

 private:
  bool has_four_corners() const;
  void distribute_linearly(const Eigen::Vector2d& point);

  std::vector<Eigen::Vector2d> positions_;
  std::vector<double> fractions_;
  std::vector<bool> is_loaded_;
};

/** Bilinear fractions of a load on the corners of a quadrilateral.
 * @param corners  Front left, front right, rear left, rear right; m. @param point  m. */
std::array<double, 4> corner_fractions(const std::array<Eigen::Vector2d, 4>& corners,
                                       const Eigen::Vector2d& point);

}  // namespace nao::sim
