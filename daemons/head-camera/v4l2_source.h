#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/rate_limiter.h"
#include "daemons/head-camera/image_source.h"
#include "daemons/head-camera/v4l2_device.h"

namespace nao::camera {

/** Images of real cameras. A camera that delivers nothing, or fails, is closed and opened again;
 * before that, all cameras are reset if the robot's files say how. */
class V4l2Source : public ImageSource {
 public:
  /** @param model  Gives the fields of view; must outlive this. @param distortion  That the lenses
   * are known to have: images are sent as they are, with these coefficients. */
  V4l2Source(const RobotModel& model, const V4l2Settings& settings, const Distortion& distortion);

  void attach(EventLoop& loop, std::function<void(const std::string&)> on_image) override;
  std::vector<CameraModel> cameras() const override { return model_.cameras(); }
  std::string missing_input(double now) const override;
  bool has_image(const std::string& camera, double now) const override;
  int64_t utime(const std::string& camera) const override;
  const CameraFrame& take(const std::string& camera, int min_width) override;
  std::vector<std::string> take_problems() override;
  std::string description() const override;

 private:
  struct Camera {
    V4l2CameraSettings settings;
    CameraFrame frame;
    std::unique_ptr<V4l2Device> device;
    /** When the last image came, or the device was opened, s, monotonic. */
    double last_time = 0;
    /** Time at which to open it, s, monotonic. */
    double open_time = 0;
    /** Why it delivers nothing. */
    std::string fault = "not opened yet";
    RateLimiter warnings{10.0};
  };

  /** Index into cameras_; their number if there is none of that name. */
  size_t find(const std::string& name) const;
  /** Opens cameras that are closed, and closes those that deliver nothing. */
  void check(double now);
  void open(Camera& camera, double now);
  void receive(Camera& camera);
  void close(Camera& camera);
  /** A camera has failed: it is opened again, after a reset of all if there is one. */
  void recover(Camera& camera, const std::string& fault, double now);
  void warn(Camera& camera, const std::string& text, double now);

  const RobotModel& model_;
  V4l2Settings settings_;
  std::vector<Camera> cameras_;
  EventLoop* loop_ = nullptr;
  std::function<void(const std::string&)> on_image_;
  std::vector<std::string> problems_;
};

}  // namespace nao::camera
