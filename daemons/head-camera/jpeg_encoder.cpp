#include "daemons/head-camera/jpeg_encoder.h"

#include <turbojpeg.h>

#include <algorithm>
#include <string>

#include "common/error.h"

namespace nao::camera {
namespace {

/** Factor on the quality for the next try. Chosen: few tries, with little more loss of quality than
 * needed. */
constexpr double kQualityFactor = 0.75;

}  // namespace

JpegEncoder::JpegEncoder() : handle_(tjInitCompress()) {
  if (handle_ == nullptr) throw Error(std::string("libturbojpeg: ") + tjGetErrorStr2(nullptr));
}

JpegEncoder::~JpegEncoder() {
  tjFree(buffer_);
  tjDestroy(handle_);
}

std::vector<uint8_t> JpegEncoder::encode(const std::vector<uint8_t>& bgrx, int width, int height,
                                         int quality, int max_bytes) {
  if (width < 1 || height < 1 || bgrx.size() != static_cast<size_t>(4) * width * height) {
    throw Error("an image of " + std::to_string(width) + "x" + std::to_string(height) +
                " pixels cannot have " + std::to_string(bgrx.size()) + " bytes");
  }
  while (true) {
    // The buffer grows as libturbojpeg requires, and is reused. Rows are bottom up, as OpenGL has
    // them.
    unsigned long num_bytes = buffer_bytes_;
    if (tjCompress2(handle_, bgrx.data(), width, 4 * width, height, TJPF_BGRX, &buffer_, &num_bytes,
                    TJSAMP_420, quality, TJFLAG_BOTTOMUP) != 0) {
      throw Error(std::string("libturbojpeg: ") + tjGetErrorStr2(handle_));
    }
    buffer_bytes_ = std::max(buffer_bytes_, num_bytes);
    if (num_bytes <= static_cast<unsigned long>(max_bytes)) {
      return {buffer_, buffer_ + num_bytes};
    }
    if (quality == 1) {
      throw Error("an image of " + std::to_string(width) + "x" + std::to_string(height) +
                  " pixels does not fit into " + std::to_string(max_bytes) + " bytes");
    }
    // It is too large for one message: try again with less quality.
    quality = std::max(1, static_cast<int>(quality * kQualityFactor));
  }
}

}  // namespace nao::camera
