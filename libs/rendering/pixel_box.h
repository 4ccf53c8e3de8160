#pragma once

#include <Eigen/Geometry>

namespace nao {

struct RenderView;

/** Rectangle of an image, pixels from its lower left corner; `right` and `top` are just outside. */
struct PixelBox {
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;

  bool is_empty() const { return left >= right || bottom >= top; }
};

bool overlap(const PixelBox& a, const PixelBox& b);

/** The box of both. */
PixelBox united(const PixelBox& a, const PixelBox& b);

/** Pixels in which a rectangle on the ground z = 0, m, may be seen: all if it reaches behind the
 * camera. */
PixelBox ground_pixels(const Eigen::AlignedBox2f& rectangle, const RenderView& view);

}  // namespace nao
