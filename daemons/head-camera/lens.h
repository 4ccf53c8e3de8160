#pragma once

#include <cstdint>
#include <vector>

#include "daemons/head-camera/distortion.h"
#include "rendering/pinhole_camera.h"

namespace nao::camera {

/** Applies lens distortion to images of a pinhole camera, by a table of source pixels. */
class Lens {
 public:
  /** @param camera  Intrinsics of the distorted image, as calibration gives them.
   * @throws ConfigError  if the image would fold over itself. */
  Lens(const PinholeCamera& camera, const Distortion& distortion);

  /** Pinhole camera to render with. It has the same size, and a field of view wide enough for every
   * pixel of the distorted image. */
  const PinholeCamera& source() const { return source_; }

  /** Distorts an image by bilinear interpolation.
   * @param ideal  Rendered with source(): rows from the bottom up, 4 bytes a pixel.
   * @param distorted  Likewise; resized. Must not be `ideal`. */
  void distort(const std::vector<uint8_t>& ideal, std::vector<uint8_t>& distorted) const;

 private:
  /** Source of a pixel: the lower left one of four neighbors, and the weights of the right and of
   * the upper ones, 1/256. */
  struct Source {
    int32_t pixel;
    uint16_t right;
    uint16_t above;
  };

  PinholeCamera source_;
  std::vector<Source> table_;
};

}  // namespace nao::camera
