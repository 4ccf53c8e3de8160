#include "daemons/head-camera/image_noise.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace nao::camera {
namespace {

/** Number of samples drawn in advance, since drawing over a million of them for each image is slow.
 * Chosen: 256 pieces, so that the pieces of an image rarely overlap. */
constexpr size_t kNumSamples = 1 << 18;
/** Bytes that get consecutive samples. Each piece begins at a random sample, so that the noise has
 * no visible period. */
constexpr size_t kPiece = 1024;

}  // namespace

ImageNoise::ImageNoise(double deviation) : samples_(kNumSamples) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, deviation);
  for (int8_t& sample : samples_) {
    sample = static_cast<int8_t>(std::lround(std::clamp(normal(random), -127.0, 127.0)));
  }
}

void ImageNoise::add(std::vector<uint8_t>& bgrx, int64_t utime) const {
  // The seed of this generator must not be 0.
  // Seeded with the image's time: the same state gives the same image in every run.
  std::minstd_rand start_of_piece(static_cast<uint32_t>(utime ^ (utime >> 32)) | 1u);
  for (size_t start = 0; start < bgrx.size(); start += kPiece) {
    const int8_t* sample = samples_.data() + start_of_piece() % (samples_.size() - kPiece);
    const size_t end = std::min(kPiece, bgrx.size() - start);
    uint8_t* piece = bgrx.data() + start;
    for (size_t i = 0; i < end; ++i) {
      const int noisy = std::clamp(piece[i] + sample[i], 0, 255);
      // The fourth byte of a pixel is padding.
      piece[i] = i % 4 == 3 ? piece[i] : static_cast<uint8_t>(noisy);
    }
  }
}

}  // namespace nao::camera
