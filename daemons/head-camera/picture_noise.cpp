#include "daemons/head-camera/picture_noise.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace nao {

PictureNoise::PictureNoise(double deviation) : samples_(1 << 18) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, deviation);
  for (int8_t& sample : samples_) {
    sample = static_cast<int8_t>(std::lround(std::clamp(normal(random), -127.0, 127.0)));
  }
}

void PictureNoise::add(std::vector<uint8_t>& bgrx, int64_t utime) const {
  // Pieces of the samples, each from another place, so that no pattern shows.
  constexpr size_t kPiece = 1024;
  std::minstd_rand place(static_cast<uint32_t>(utime ^ (utime >> 32)) | 1u);
  for (size_t start = 0; start < bgrx.size(); start += kPiece) {
    const int8_t* sample = samples_.data() + place() % (samples_.size() - kPiece);
    const size_t end = std::min(kPiece, bgrx.size() - start);
    uint8_t* piece = bgrx.data() + start;
    for (size_t i = 0; i < end; ++i) {
      const int noisy = std::clamp(piece[i] + sample[i], 0, 255);
      piece[i] = i % 4 == 3 ? piece[i] : static_cast<uint8_t>(noisy);
    }
  }
}

}  // namespace nao
