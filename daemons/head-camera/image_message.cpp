#include "daemons/head-camera/image_message.h"

#include <algorithm>
#include <naolcm/image_t.hpp>

#include "daemons/head-camera/head_camera.h"
#include "daemons/head-camera/image_requests.h"
#include "daemons/head-camera/jpeg_encoder.h"

namespace nao::camera {
namespace {

/** Bytes reserved for the fields besides the image; they take about 130. */
constexpr int kHeaderBytes = 512;

}  // namespace

naolcm::image_t encode_image(const CameraFrame& frame, const ImageRequest& request,
                             int default_quality, JpegEncoder& encoder) {
  // Intrinsics for the size that is sent.
  const PinholeCamera pinhole = frame.pinhole.resized(request.width);
  naolcm::image_t image;
  image.utime = frame.utime;
  image.camera = frame.camera;
  image.width = pinhole.width;
  image.height = pinhole.height;
  image.fx = pinhole.fx;
  image.fy = pinhole.fy;
  image.cx = pinhole.cx;
  image.cy = pinhole.cy;
  // In units of the focal length, so the same for every size.
  const auto coefficients = frame.distortion.coefficients();
  std::copy(coefficients.begin(), coefficients.end(), image.distortion);
  image.exposure_time = frame.exposure_time;
  image.format = "jpeg";
  const int quality = request.quality > 0 ? request.quality : default_quality;
  // The smallest level that is at least as wide: widths are those of the levels.
  image.data = encoder.encode(frame.bgrx[CameraFrame::level(request.width)], image.width,
                              image.height, quality, kMaxMessageBytes - kHeaderBytes);
  image.size_bytes = static_cast<int>(image.data.size());
  return image;
}

}  // namespace nao::camera
