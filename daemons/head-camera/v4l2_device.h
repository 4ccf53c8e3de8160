#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "daemons/head-camera/v4l2_settings.h"

namespace nao::camera {

/** A camera that streams images through Video4Linux2: YUYV, 640x480, 30 a second, in buffers that
 * the driver and this process share. */
class V4l2Device {
 public:
  /** Opens the device, sets format, rate and controls, and starts the stream. Controls that the
   * camera refuses are problems, not errors. @throws Error  naming the device and the step. */
  explicit V4l2Device(const V4l2CameraSettings& settings);
  /** Stops the stream. */
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  /** Readable when an image has arrived. */
  int descriptor() const { return descriptor_; }

  /** Takes the images that have arrived and keeps the newest; damaged ones are dropped.
   * @return Whether there is a new image. @throws Error  if the camera has failed. */
  bool receive();
  bool has_image() const { return newest_ >= 0; }
  /** YUYV of the newest image, rows from the top down. Valid until receive(). */
  std::span<const uint8_t> image() const;
  /** Start of its exposure as the driver reports it, else its time of arrival: s of
   * CLOCK_MONOTONIC. */
  double image_time() const { return image_time_; }
  /** Fixed exposure time, s; 0 if the camera chooses it. */
  double exposure_time() const { return exposure_time_; }
  /** Controls that were refused, one sentence each. */
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  struct Buffer {
    uint8_t* start;
    size_t length;
  };

  void check_capabilities();
  void set_format();
  void set_rate();
  void map_buffers();
  void set_controls(const V4l2CameraSettings& settings);
  void queue(int buffer);
  void release();
  [[noreturn]] void fail(const std::string& step) const;

  std::string device_;
  int descriptor_ = -1;
  std::vector<Buffer> buffers_;
  /** Buffer of the newest image; -1: none. */
  int newest_ = -1;
  double image_time_ = 0;
  double exposure_time_ = 0;
  std::vector<std::string> problems_;
};

}  // namespace nao::camera
