// Fuzzer of what a camera's messages can hold: decodes a file as JPEG, and runs perception on it.
#include <cstdint>

#include "daemons/vision/jpeg_decoder.h"
#include "daemons/vision/vision_core.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static nao::vision::JpegDecoder decoder;
  cv::Mat image;
  if (!decoder.decode(data, size, image).empty()) return 0;
  nao::vision::VisionCore core;
  nao::vision::VisionInput input;
  input.bgr = image;
  input.calibration = nao::vision::CameraCalibration::guess(image.cols, image.rows);
  static_cast<void>(core.process(input));
  return 0;
}
