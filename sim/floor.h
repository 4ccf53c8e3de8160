#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace nao::sim {

/** Shape of a floor. */
struct FloorOptions {
  /** Greatest height of its bumps, m; 0: flat. */
  double bump_height = 0;
  /** Distance between the points at which a height is drawn, m, along x and y. */
  double bump_grid = 0.1;
  /** Determines the heights. */
  uint64_t seed = 0;
};

/** The floor's height over W's plane z = 0, for every engine.
 *
 * Heights at the points of a grid are uniform in [0, bump_height], by the seed. Each cell between
 * four of them is two triangles, which meet at the diagonal along (1, 1): MuJoCo's height fields
 * are the same surface. */
class Floor {
 public:
  /** The tangent plane. */
  struct Plane {
    /** m. */
    double height = 0;
    /** Unit vector, upwards. */
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  };

  Floor() = default;
  explicit Floor(const FloorOptions& options) : options_(options) {}

  const FloorOptions& options() const { return options_; }
  bool is_flat() const { return !(options_.bump_height > 0); }
  /** No point is higher, m. */
  double max_height() const { return is_flat() ? 0 : options_.bump_height; }
  Plane at(double x, double y) const;
  /** Height at a point of the grid, x = column * bump_grid, y = row * bump_grid, m. */
  double grid_height(int64_t column, int64_t row) const;

 private:
  FloorOptions options_;
};

}  // namespace nao::sim
