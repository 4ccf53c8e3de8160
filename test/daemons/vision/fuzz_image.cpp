// Fuzzer of what a camera's messages can hold: decodes a file as JPEG, and runs perception on it.
//
// Random bytes are not a JPEG file, and a fuzzer does not find its headers by itself in hours:
// other input is replaced by a valid file, which is then mutated.
#include <turbojpeg.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "daemons/vision/jpeg_decoder.h"
#include "daemons/vision/vision_core.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/** A JPEG file of the least size that is decoded: a green field with a line and a ball. */
std::vector<uint8_t> make_jpeg(int quality, bool is_gray) {
  std::vector<uint8_t> bgr(3 * kWidth * kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool is_line = std::abs(x - y) < 3;
      const bool is_ball = (x - 40) * (x - 40) + (y - 30) * (y - 30) < 50;
      uint8_t* pixel = &bgr[static_cast<size_t>(3 * (y * kWidth + x))];
      pixel[0] = pixel[2] = is_line || is_ball ? 230 : 40;
      pixel[1] = is_line || is_ball ? 230 : 120;
    }
  }
  const tjhandle handle = tjInitCompress();
  unsigned char* file = nullptr;
  unsigned long num_bytes = 0;
  tjCompress2(handle, bgr.data(), kWidth, 0, kHeight, TJPF_BGR, &file, &num_bytes,
              is_gray ? TJSAMP_GRAY : TJSAMP_420, quality, 0);
  std::vector<uint8_t> result(file, file + num_bytes);
  tjFree(file);
  tjDestroy(handle);
  return result;
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned int seed) {
  const bool is_jpeg = size > 3 && data[0] == 0xff && data[1] == 0xd8;
  std::minstd_rand random(seed);
  // Sometimes input with another beginning is used.
  if (!is_jpeg && random() % 16 != 0) {
    const std::vector<uint8_t> file =
        make_jpeg(20 + static_cast<int>(random() % 80), random() % 4 == 0);
    size = std::min(file.size(), max_size);
    std::memcpy(data, file.data(), size);
  }
  return LLVMFuzzerMutate(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  // Its networks are read once.
  static const nao::vision::VisionNetworks networks = nao::vision::VisionNetworks::load();
  cv::Mat image;
  if (!nao::vision::decode_jpeg(data, size, image).empty()) return 0;
  nao::vision::VisionCore core(networks);
  nao::vision::VisionInput input;
  input.bgr = image;
  input.calibration = nao::vision::CameraCalibration::guess(image.cols, image.rows);
  // A pose is given, so that circle, posts, robots and localisation are also run.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 0.5;
  pose.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()).matrix();
  input.pose_camera_in_heading = pose;
  input.heading_in_odometry = nao::Pose2{};
  core.localize(nao::vision::FieldModel(nao::SceneFile::find("soccer")), nao::Pose2{{-2, 0}, 0});
  static_cast<void>(core.process(input));
  return 0;
}
