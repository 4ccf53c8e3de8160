#include "sim/foot_load.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace nao::sim {

using Eigen::Matrix2d;
using Eigen::Vector2d;

std::array<double, 4> corner_fractions(const std::array<Vector2d, 4>& corners,
                                       const Vector2d& point) {
  // Coordinates s from rear (0) to front (1) and t from right to left, by Newton's method on the
  // two bilinear equations. Sensors lie nearly on a rectangle, for which the first iteration is
  // exact.
  constexpr int kIterations = 6;
  // Below this area, m^2, the corners lie on a line, where s or t is arbitrary.
  constexpr double kMinDeterminant = 1e-12;
  const Vector2d& front_left = corners[0];
  const Vector2d& front_right = corners[1];
  const Vector2d& rear_left = corners[2];
  const Vector2d& rear_right = corners[3];
  double s = 0.5;
  double t = 0.5;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // Residual of the bilinear map P(s, t) = s F(t) + (1 - s) R(t), with F between the front
    // corners and R between the rear ones; its partial derivatives are the Jacobian's columns.
    const Vector2d front = t * front_left + (1 - t) * front_right;
    const Vector2d rear = t * rear_left + (1 - t) * rear_right;
    const Vector2d error = point - (s * front + (1 - s) * rear);
    const Vector2d along_s = front - rear;
    const Vector2d along_t = s * (front_left - front_right) + (1 - s) * (rear_left - rear_right);
    const double determinant = along_s.x() * along_t.y() - along_s.y() * along_t.x();
    if (std::abs(determinant) < kMinDeterminant) break;
    // Newton step, with the 2 x 2 system solved by Cramer's rule.
    s += (error.x() * along_t.y() - error.y() * along_t.x()) / determinant;
    t += (along_s.x() * error.y() - along_s.y() * error.x()) / determinant;
  }
  // Beyond the quadrilateral: its edge carries the load.
  s = std::clamp(s, 0.0, 1.0);
  t = std::clamp(t, 0.0, 1.0);
  // The bilinear weights of the four corners: positive, and their sum is 1.
  return {s * t, s * (1 - t), (1 - s) * t, (1 - s) * (1 - t)};
}

FootLoad::FootLoad(std::vector<Vector2d> positions)
    : positions_(std::move(positions)),
      fractions_(positions_.size(), 0.0),
      is_loaded_(positions_.size(), false) {}

// Checks that front, rear, left and right sensors are where their order says, as bilinear weights
// require.
bool FootLoad::has_four_corners() const {
  if (positions_.size() != 4) return false;
  const Vector2d& front_left = positions_[0];
  const Vector2d& front_right = positions_[1];
  const Vector2d& rear_left = positions_[2];
  const Vector2d& rear_right = positions_[3];
  return std::min(front_left.x(), front_right.x()) > std::max(rear_left.x(), rear_right.x()) &&
         std::min(front_left.y(), rear_left.y()) > std::max(front_right.y(), rear_right.y());
}

const std::vector<double>& FootLoad::distribute(const Vector2d& center_of_pressure) {
  if (has_four_corners()) {
    const std::array<double, 4> fractions = corner_fractions(
        {positions_[0], positions_[1], positions_[2], positions_[3]}, center_of_pressure);
    std::copy(fractions.begin(), fractions.end(), fractions_.begin());
  } else {
    distribute_linearly(center_of_pressure);
  }
  return fractions_;
}

void FootLoad::distribute_linearly(const Vector2d& point) {
  // Eigenvalues of the second moments below this part of the larger one count as 0: the loaded
  // sensors lie on a line.
  constexpr double kRankTolerance = 1e-9;
  // Rounding.
  constexpr double kNegative = -1e-12;
  // Active-set method: the least-norm solution first; while a sensor would have to pull, the one
  // that pulls most is taken out and the rest is solved again. At most one pass per sensor.
  std::fill(is_loaded_.begin(), is_loaded_.end(), true);
  for (size_t num_loaded = positions_.size(); num_loaded > 0; --num_loaded) {
    const auto count = static_cast<double>(num_loaded);
    // Center and second moments of the sensors that still carry load, in the sole's frame.
    Vector2d center = Vector2d::Zero();
    for (size_t i = 0; i < positions_.size(); ++i) {
      if (is_loaded_[i]) center += positions_[i] / count;
    }
    Matrix2d moments = Matrix2d::Zero();
    for (size_t i = 0; i < positions_.size(); ++i) {
      if (!is_loaded_[i]) continue;
      const Vector2d offset = positions_[i] - center;
      moments += offset * offset.transpose();
    }
    // fraction_i = 1 / count + gradient . offset_i with moments * gradient = point - center, solved
    // by the pseudo-inverse: sensors on a line carry the nearest point of the line.
    Eigen::SelfAdjointEigenSolver<Matrix2d> solver;
    solver.computeDirect(moments);
    Vector2d gradient = Vector2d::Zero();
    // Pseudo-inverse by the eigenvectors: directions without extent have no gradient.
    for (int k = 0; k < 2; ++k) {
      const double value = solver.eigenvalues()[k];
      if (value <= kRankTolerance * solver.eigenvalues()[1]) continue;
      const Vector2d axis = solver.eigenvectors().col(k);
      gradient += axis * axis.dot(point - center) / value;
    }
    // The most negative fraction of this pass.
    size_t least = 0;
    double least_fraction = 1;
    for (size_t i = 0; i < positions_.size(); ++i) {
      fractions_[i] = is_loaded_[i] ? 1 / count + gradient.dot(positions_[i] - center) : 0;
      if (!is_loaded_[i] || fractions_[i] >= least_fraction) continue;
      least_fraction = fractions_[i];
      least = i;
    }
    if (least_fraction >= kNegative) break;
    is_loaded_[least] = false;
  }
  // Rounding may leave tiny negative numbers.
  for (double& fraction : fractions_) fraction = std::max(fraction, 0.0);
}

}  // namespace nao::sim
