#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "rendering/render_view.h"
#include "robot_model/scene_file.h"

namespace nao {

/** Rectangle on the ground with an image of one kind in it. */
struct GroundPatch {
  /** m, in the world. */
  Eigen::AlignedBox2f box;
  /** For a patch with one straight line: the line's unit normal on the ground, and the coordinate
   * of its middle along the normal, m. */
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();
  float middle = 0;
  /** The line is the edge of the carpet, with the normal outwards. */
  bool is_edge = false;
};

/** Divides the ground of a soccer field into patches, each of which is drawn by the cheapest shader
 * that shows what is in it. */
class FieldPatches {
 public:
  FieldPatches() = default;
  /** @param reach  Half the side of the ground's square, m. */
  FieldPatches(const FieldDimensions& field, float reach);

  /** Computes the patches for a view. Patches of different kinds overlap: lines are to be drawn
   * over the carpet, and `mixed` over both. */
  void select(const RenderView& view);

  /** Ends and crossings of lines, the circle, the marks, corners of the carpet. */
  const std::vector<GroundPatch>& mixed() const { return mixed_; }
  /** Parts of straight lines and edges: no pixel of a patch shows another one. */
  const std::vector<GroundPatch>& lines() const { return lines_; }
  /** The carpet. No two overlap, and neighbors have two corners in common. */
  const std::vector<GroundPatch>& carpet() const { return carpet_; }
  /** The ground around the carpet, as carpet(). */
  const std::vector<GroundPatch>& hall() const { return hall_; }

 private:
  /** A part of a line. */
  struct Piece {
    /** Its middle. */
    Eigen::AlignedBox2f middle;
    Eigen::Vector2f normal;
    bool is_edge;
    /** Half of its width, m. */
    float half_width;
    /** Distance from the middle of the nearest other line, m. */
    float clearance;
  };

  void add_lines(const FieldDimensions& field);
  /** Lines along the sides of a rectangle about the origin. */
  void add_frame(const Eigen::Vector2f& corner, float half_width, bool is_edge);
  void add_line(const Eigen::Vector2f& from, const Eigen::Vector2f& to,
                const Eigen::Vector2f& normal, float half_width, bool is_edge = false);

  std::vector<Piece> pieces_;
  std::vector<GroundPatch> all_carpet_;
  std::vector<GroundPatch> all_hall_;
  std::vector<GroundPatch> mixed_;
  std::vector<GroundPatch> lines_;
  std::vector<GroundPatch> carpet_;
  std::vector<GroundPatch> hall_;
};

}  // namespace nao
