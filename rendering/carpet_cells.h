#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "rendering/render_view.h"
#include "robot_model/scene_file.h"

namespace nao {

/** The parts of a field's carpet in which no pixel of an image shows a line: they are drawn without
 * looking for lines, which saves most of the ground's shading. */
class CarpetCells {
 public:
  CarpetCells() = default;
  explicit CarpetCells(const FieldDimensions& field);

  /** Rectangles on the ground, m, in which every pixel of this view shows carpet only. They do not
   * overlap. */
  const std::vector<Eigen::AlignedBox2f>& without_lines(const RenderView& view);

 private:
  struct Cell {
    Eigen::AlignedBox2f box;
    /** Distance to the nearest line or edge of the carpet, m. */
    float clearance;
  };

  /** In rows along y, each from -y to y. */
  std::vector<Cell> cells_;
  std::vector<Eigen::AlignedBox2f> selected_;
};

}  // namespace nao
