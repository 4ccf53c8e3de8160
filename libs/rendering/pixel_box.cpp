#include "rendering/pixel_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/render_view.h"

namespace nao {

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

PixelBox united(const PixelBox& a, const PixelBox& b) {
  return {std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right),
          std::max(a.top, b.top)};
}

PixelBox ground_pixels(const Eigen::AlignedBox2f& rectangle, const RenderView& view) {
  using Box = Eigen::AlignedBox2f;
  Eigen::Vector2f lower = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector2f upper = -lower;
  for (const auto corner : {Box::BottomLeft, Box::BottomRight, Box::TopLeft, Box::TopRight}) {
    const Eigen::Vector2f place = rectangle.corner(corner);
    const Eigen::Vector4f clip = view.clip_from_world * Eigen::Vector4f(place.x(), place.y(), 0, 1);
    // A corner behind the camera has no place in the image: no bound can be given.
    if (clip.w() < static_cast<float>(kNearPlane)) return {0, 0, view.width, view.height};
    lower = lower.cwiseMin(clip.head<2>() / clip.w());
    upper = upper.cwiseMax(clip.head<2>() / clip.w());
  }
  // Clip coordinates -1..1 to pixels, clamped to the image.
  const auto pixel = [](float in_clip, int size) {
    return std::clamp((in_clip + 1) / 2, 0.0f, 1.0f) * static_cast<float>(size);
  };
  return {static_cast<int>(std::floor(pixel(lower.x(), view.width))),
          static_cast<int>(std::floor(pixel(lower.y(), view.height))),
          static_cast<int>(std::ceil(pixel(upper.x(), view.width))),
          static_cast<int>(std::ceil(pixel(upper.y(), view.height)))};
}

}  // namespace nao
