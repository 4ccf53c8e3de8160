#pragma once

#include <cstdint>
#include <vector>

#include "rendering/pinhole_camera.h"

namespace nao {

/** Bends an ideal picture as a lens does: radial distortion by the model of Brown, "Close-range
 * camera calibration" (1971). A point that a pinhole camera shows at the distance r from the
 * principal point, in focal lengths, appears at r (1 + k1 r^2 + k2 r^4); k1 below 0 is a barrel,
 * above 0 a cushion. */
class Lens {
 public:
  /** @param camera  What the bent picture has in its middle: its size, focal lengths, principal
   * point.
   * @throws ConfigError  if the picture would fold over itself. */
  Lens(const PinholeCamera& camera, double k1, double k2);

  /** The ideal camera to draw with: of the same size, and wide enough for the bent picture's
   * corners. */
  const PinholeCamera& source() const { return source_; }

  /** @param ideal  Drawn with source(): rows from the bottom up, 4 bytes a pixel.
   * @param bent  Likewise; resized. Must not be `ideal`. */
  void bend(const std::vector<uint8_t>& ideal, std::vector<uint8_t>& bent) const;

 private:
  /** Where a pixel comes from: the lower left one of four, and the share of those right and above,
   * 1/256. */
  struct Origin {
    int32_t pixel;
    uint16_t right;
    uint16_t above;
  };

  PinholeCamera source_;
  std::vector<Origin> origins_;
};

}  // namespace nao
