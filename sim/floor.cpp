#include "sim/floor.h"

#include <cmath>

#include "common/random.h"

namespace nao::sim {

// Height of a grid point, m: a hash of column, row and seed makes it uniform in [0, bump_height)
// without a table, so that the floor is unbounded and the same in every program.
double Floor::grid_height(int64_t column, int64_t row) const {
  if (is_flat()) return 0;
  // Odd constants of SplitMix64 and of its finalizer keep rows and columns apart.
  const uint64_t point = static_cast<uint64_t>(column) * 0xbf58476d1ce4e5b9u +
                         static_cast<uint64_t>(row) * 0x94d049bb133111ebu;
  return Random(options_.seed ^ point).uniform(0, options_.bump_height);
}

Floor::Plane Floor::at(double x, double y) const {
  Plane plane;
  // Beyond 1e9 cells a robot has left all physical bounds long ago.
  const double grid = options_.bump_grid;
  if (is_flat() || !(std::abs(x) < 1e9 * grid) || !(std::abs(y) < 1e9 * grid)) return plane;
  // Cell coordinates: the integer part names the cell, the fraction is the position in it.
  const double u = x / grid;
  const double v = y / grid;
  const auto column = static_cast<int64_t>(std::floor(u));
  const auto row = static_cast<int64_t>(std::floor(v));
  const double along_x = u - static_cast<double>(column);
  const double along_y = v - static_cast<double>(row);
  // Corners of the cell on its diagonal, which divides it into two triangles (piecewise linear
  // interpolation, continuous across cells).
  const double near = grid_height(column, row);
  const double far = grid_height(column + 1, row + 1);
  // Rise over a cell along x and y, on the triangle below or above the diagonal.
  double rise_x = 0;
  double rise_y = 0;
  if (along_x >= along_y) {
    const double right = grid_height(column + 1, row);
    rise_x = right - near;
    rise_y = far - right;
  } else {
    const double left = grid_height(column, row + 1);
    rise_x = far - left;
    rise_y = left - near;
  }
  plane.height = near + along_x * rise_x + along_y * rise_y;
  // Normal of z = f(x, y): (-df/dx, -df/dy, 1), normalized.
  plane.normal = Eigen::Vector3d(-rise_x / grid, -rise_y / grid, 1).normalized();
  return plane;
}

}  // namespace nao::sim
