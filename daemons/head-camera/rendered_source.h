#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "daemons/head-camera/image_source.h"
#include "robot_model/robot_models.h"

namespace naolcm {
class world_truth_t;
}

namespace nao {
class Bus;
}

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
  /** Unless needed, it receives one state every half second, to notice a simulator that ends. */
  void set_needed(bool is_needed) override;
  std::string missing_input(double now) const override;
  bool has_image(const std::string& camera, double now) const override;
  int64_t utime(const std::string& camera) const override;
  const CameraFrame& take(const std::string& camera, int min_width) override;
  std::vector<std::string> take_problems() override;
  std::string description() const override;

 private:
  void receive_truth(const naolcm::world_truth_t& truth);
  /** Takes the newest state just before an image, so that the others need not wake the process. */
  void read_states();

  Bus& bus_;
  EventLoop* loop_ = nullptr;
  int timer_ = -1;
  bool is_needed_ = true;
  /** Motion during the exposure is interpolated between two states in succession. */
  bool needs_every_state_;
  /** Since when images are needed, s, monotonic: states of before are outdated. */
  double needed_since_ = 0;
  const RobotModel& model_;
  RobotModels models_;
  std::string robot_;
  HeadCamera camera_;
  /** The newest state, and the one before it. */
  std::optional<WorldState> world_;
  std::optional<WorldState> earlier_;
  /** When the newest came, s, monotonic. */
  double last_truth_ = 0;
};

}  // namespace nao::camera
