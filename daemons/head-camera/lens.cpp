#include "daemons/head-camera/lens.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"

namespace nao {
namespace {

/** Distance in the ideal picture of what the bent one shows at `bent_radius`; both in focal
 * lengths. */
double ideal_radius(double bent_radius, double k1, double k2) {
  double radius = bent_radius;
  for (int i = 0; i < 20; ++i) {  // Newton; a folded picture has no growing distance
    const double square = radius * radius;
    const double slope = 1 + square * (3 * k1 + square * 5 * k2);
    if (!(slope > 0)) break;
    const double excess = radius * (1 + square * (k1 + square * k2)) - bent_radius;
    radius -= excess / slope;
    if (std::abs(excess) < 1e-12) return radius;
  }
  throw ConfigError("a distortion of " + std::to_string(k1) + ", " + std::to_string(k2) +
                    " folds the picture over itself; choose values nearer to 0");
}

/** The ideal picture's point, in focal lengths, of a bent picture's pixel. */
Eigen::Vector2d ideal_point(const PinholeCamera& camera, double u, double v, double k1, double k2) {
  const Eigen::Vector2d bent((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
  const double radius = bent.norm();
  return radius > 0 ? Eigen::Vector2d(bent * (ideal_radius(radius, k1, k2) / radius)) : bent;
}

}  // namespace

Lens::Lens(const PinholeCamera& camera, double k1, double k2) : source_(camera) {
  const auto ideal = [&](int u, int v) { return ideal_point(camera, u, v, k1, k2); };
  // A barrel's corners lie outside the plain picture: draw with a shorter focal length.
  double widening = 1;
  for (const int v : {0, camera.height - 1}) {
    for (const int u : {0, camera.width - 1}) {
      const Eigen::Vector2d corner = ideal(u, v);
      widening = std::max({widening, corner.x() * camera.fx / (u - camera.cx),
                           corner.y() * camera.fy / (v - camera.cy)});
    }
  }
  source_.fx /= widening;
  source_.fy /= widening;

  constexpr double kOne = 256;
  origins_.reserve(static_cast<size_t>(camera.width) * camera.height);
  for (int row = 0; row < camera.height; ++row) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d point = ideal(u, camera.height - 1 - row);
      const double column = source_.cx + source_.fx * point.x();
      const double line = camera.height - 1 - (source_.cy + source_.fy * point.y());
      const double left = std::clamp(std::floor(column), 0.0, camera.width - 2.0);
      const double below = std::clamp(std::floor(line), 0.0, camera.height - 2.0);
      origins_.push_back({static_cast<int32_t>(below) * camera.width + static_cast<int32_t>(left),
                          static_cast<uint16_t>(kOne * std::clamp(column - left, 0.0, 1.0)),
                          static_cast<uint16_t>(kOne * std::clamp(line - below, 0.0, 1.0))});
    }
  }
}

void Lens::bend(const std::vector<uint8_t>& ideal, std::vector<uint8_t>& bent) const {
  bent.resize(4 * origins_.size());
  const size_t row_bytes = static_cast<size_t>(4) * source_.width;
  for (size_t i = 0; i < origins_.size(); ++i) {
    const Origin& origin = origins_[i];
    const uint8_t* lower = ideal.data() + static_cast<size_t>(4) * origin.pixel;
    const uint8_t* upper = lower + row_bytes;
    for (int channel = 0; channel < 4; ++channel) {
      const uint32_t low =
          lower[channel] * (256u - origin.right) + lower[channel + 4] * uint32_t{origin.right};
      const uint32_t high =
          upper[channel] * (256u - origin.right) + upper[channel + 4] * uint32_t{origin.right};
      bent[4 * i + channel] =
          static_cast<uint8_t>((low * (256u - origin.above) + high * origin.above + 32768u) >> 16);
    }
  }
}

}  // namespace nao
