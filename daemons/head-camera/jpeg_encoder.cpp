#include "daemons/head-camera/jpeg_encoder.h"

#include <turbojpeg.h>

#include <algorithm>
#include <string>

#include "common/error.h"

namespace nao {
namespace {

/** The quality falls by this factor until the file is small enough. */
constexpr double kNextQuality = 0.75;

}  // namespace

JpegEncoder::JpegEncoder() : handle_(tjInitCompress()) {
  if (handle_ == nullptr) throw Error(std::string("libturbojpeg: ") + tjGetErrorStr2(nullptr));
}

JpegEncoder::~JpegEncoder() {
  tjFree(buffer_);
  tjDestroy(handle_);
}

std::vector<uint8_t> JpegEncoder::encode(const std::vector<uint8_t>& bgrx, int width, int height,
                                         int quality, int most_bytes) {
  if (width < 1 || height < 1 || bgrx.size() != static_cast<size_t>(4) * width * height) {
    throw Error("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                " cannot have " + std::to_string(bgrx.size()) + " bytes");
  }
  while (true) {
    unsigned long num_bytes = buffer_bytes_;
    if (tjCompress2(handle_, bgrx.data(), width, 4 * width, height, TJPF_BGRX, &buffer_, &num_bytes,
                    TJSAMP_420, quality, TJFLAG_BOTTOMUP) != 0) {
      throw Error(std::string("libturbojpeg: ") + tjGetErrorStr2(handle_));
    }
    buffer_bytes_ = std::max(buffer_bytes_, num_bytes);
    if (num_bytes <= static_cast<unsigned long>(most_bytes)) {
      return {buffer_, buffer_ + num_bytes};
    }
    if (quality == 1) {
      throw Error("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                  " does not fit into " + std::to_string(most_bytes) + " bytes");
    }
    quality = std::max(1, static_cast<int>(quality * kNextQuality));
  }
}

}  // namespace nao
