#include "daemons/head-camera/lens.h"

#include <algorithm>
#include <cmath>

namespace nao::camera {
namespace {

/** Point in the image plane at distance 1 that a distorted image shows in a pixel. */
Eigen::Vector2d ideal_point(const PinholeCamera& camera, const Distortion& distortion, int u,
                            int v) {
  return undistorted(distortion, {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy});
}

/** Factor on the size of the image plane by which all ideal points fit into an image with the given
 * intrinsics; at least 1. The points farthest out are on the border. */
double widening(const PinholeCamera& camera, const Distortion& distortion) {
  double factor = 1;
  const auto include = [&](int u, int v) {
    const Eigen::Vector2d point = ideal_point(camera, distortion, u, v);
    // Room between the principal point and the border on that side of the image, pixels.
    const double width = point.x() > 0 ? camera.width - 1 - camera.cx : camera.cx;
    const double height = point.y() > 0 ? camera.height - 1 - camera.cy : camera.cy;
    factor = std::max({factor, std::abs(point.x()) * camera.fx / width,
                       std::abs(point.y()) * camera.fy / height});
  };
  for (int u = 0; u < camera.width; ++u) {
    include(u, 0);
    include(u, camera.height - 1);
  }
  for (int v = 0; v < camera.height; ++v) {
    include(0, v);
    include(camera.width - 1, v);
  }
  return factor;
}

}  // namespace

Lens::Lens(const PinholeCamera& camera, const Distortion& distortion) : source_(camera) {
  // A barrel distortion shows points outside the ideal image, so the image is rendered with a
  // shorter focal length.
  const double factor = widening(camera, distortion);
  source_.fx /= factor;
  source_.fy /= factor;

  constexpr double kOne = 256;  // weights are fractions of 8 bits
  table_.reserve(static_cast<size_t>(camera.width) * camera.height);
  for (int row = 0; row < camera.height; ++row) {
    for (int u = 0; u < camera.width; ++u) {
      // Rows count upwards, v downwards.
      const Eigen::Vector2d point = ideal_point(camera, distortion, u, camera.height - 1 - row);
      const double column = source_.cx + source_.fx * point.x();
      const double line = camera.height - 1 - (source_.cy + source_.fy * point.y());
      // The four pixels around the point; at the border the last pair, with a weight of 1 at most.
      const double left = std::clamp(std::floor(column), 0.0, camera.width - 2.0);
      const double below = std::clamp(std::floor(line), 0.0, camera.height - 2.0);
      table_.push_back({static_cast<int32_t>(below) * camera.width + static_cast<int32_t>(left),
                        static_cast<uint16_t>(kOne * std::clamp(column - left, 0.0, 1.0)),
                        static_cast<uint16_t>(kOne * std::clamp(line - below, 0.0, 1.0))});
    }
  }
}

// Bilinear interpolation with 8-bit weights, channel by channel.
void Lens::distort(const std::vector<uint8_t>& ideal, std::vector<uint8_t>& distorted) const {
  distorted.resize(4 * table_.size());
  const size_t row_bytes = static_cast<size_t>(4) * source_.width;
  for (size_t i = 0; i < table_.size(); ++i) {
    const Source& source = table_[i];
    const uint8_t* lower = ideal.data() + static_cast<size_t>(4) * source.pixel;
    const uint8_t* upper = lower + row_bytes;
    for (int channel = 0; channel < 4; ++channel) {
      const uint32_t low =
          lower[channel] * (256u - source.right) + lower[channel + 4] * uint32_t{source.right};
      const uint32_t high =
          upper[channel] * (256u - source.right) + upper[channel + 4] * uint32_t{source.right};
      // Both weights are 1/256: 32768 is one half of their product.
      distorted[4 * i + channel] =
          static_cast<uint8_t>((low * (256u - source.above) + high * source.above + 32768u) >> 16);
    }
  }
}

}  // namespace nao::camera
