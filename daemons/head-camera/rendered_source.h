#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/rate_limiter.h"
#include "daemons/head-camera/image_source.h"
#include "robot_model/robot_models.h"

namespace nao::camera {

/** Images rendered from WORLD_TRUTH: those of a simulated robot. */
class RenderedSource : public ImageSource {
 public:
  /** Subscribes, and renders one image of each camera, since the first one takes long (shaders are
   * compiled). @param bus, model  Must outlive this. */
  RenderedSource(Bus& bus, const RobotModel& model, const HeadCameraOptions& options);

  void attach(EventLoop& loop, std::function<void(const std::string&)> on_image) override;
  /** Cameras of the robot, and the overview. */
  std::vector<CameraModel> cameras() const override;
  std::string missing_input(double now) override;
  bool has_image(const std::string& camera, double now) override;
  int64_t utime(const std::string& camera) const override;
  const CameraFrame& take(const std::string& camera, int min_width) override;
  std::vector<std::string> take_problems() override;
  std::string description() const override;

 private:
  void receive_truth(const RawMessage& message);
  void decode(double now);

  const RobotModel& model_;
  RobotModels models_;
  std::string robot_;
  /** Whether the state before the newest is needed, to draw the motion during the exposure. */
  bool needs_earlier_;
  HeadCamera camera_;
  /** The newest state, its robot time, microseconds, and the one before it, as they were received.
   */
  std::vector<uint8_t> newest_;
  std::vector<uint8_t> earlier_;
  int64_t utime_ = 0;
  bool is_decoded_ = true;
  /** The same, decoded when an image was due. */
  std::optional<WorldState> world_;
  std::optional<WorldState> earlier_world_;
  /** When the newest came, and when one was decoded, s, monotonic. */
  double last_truth_ = 0;
  double last_decoded_ = 0;
  std::vector<std::string> problems_;
  RateLimiter warnings_{1.0};
};

}  // namespace nao::camera
