#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/channels.h"
#include "common/rate_limiter.h"
#include "common/status_reporter.h"
#include "daemons/head-camera/head_camera.h"
#include "daemons/head-camera/head_camera_options.h"
#include "daemons/head-camera/image_requests.h"
#include "daemons/head-camera/jpeg_encoder.h"

namespace naolcm {
class camera_command_t;
class world_truth_t;
}  // namespace naolcm

namespace nao {
class Bus;
class EventLoop;
}  // namespace nao

namespace nao::camera {

/** Connects HeadCamera to the bus: receives WORLD_TRUTH and NAO_HEAD_CAMERA_COMMAND, publishes
 * NAO_HEAD_CAMERA_IMAGE. It renders only while it has recent truth and a valid request. */
class HeadCameraDaemon {
 public:
  /** Subscribes, and renders one image of each camera, since the first one takes long (shaders are
   * compiled).
   * @param bus, model  Must outlive this. */
  HeadCameraDaemon(Bus& bus, const RobotModel& model, const HeadCameraOptions& options);

  /** Registers message handling, images and status with the loop. */
  void attach(EventLoop& loop);

  /** One step, to be called kMaxRate times a second: renders and publishes the images that are due.
   * @param now  s, monotonic. */
  void step(double now);

  /** Publishes the status, with the figures since the last call. */
  void publish_status();

  /** Images rendered since the start. */
  int64_t num_frames() const { return num_frames_; }

 private:
  void receive_truth(const naolcm::world_truth_t& truth);
  void receive_command(const naolcm::camera_command_t& command);
  std::vector<ImageRequest> valid_requests(double now);
  /** Removes the requests whose last image already shows the current state. */
  void remove_unchanged(std::vector<ImageRequest>& due, double now);
  void send_images(const std::string& camera, const std::vector<ImageRequest>& due, double now);
  void report_problems();
  /** The input that is missing for rendering, in words; empty if nothing is missing. */
  std::string missing_input(double now) const;
  void update_state(double now, bool has_requests);

  /** The last image published of one camera and width. */
  struct Sent {
    /** Robot time of the state. */
    int64_t utime;
    /** s, monotonic. */
    double time;
  };

  /** Figures since the last status message. */
  struct Figures {
    int num_frames = 0;
    double drawing_time = 0;
    double largest_message_bytes = 0;
  };

  Bus& bus_;
  const RobotModel& model_;
  HeadCameraOptions options_;
  RobotChannels channels_;
  StatusReporter status_;
  HeadCamera camera_;
  JpegEncoder encoder_;
  ImageRequests requests_;
  ImageSchedule schedule_;
  /** The newest state, and the one before it. */
  std::optional<WorldState> world_;
  std::optional<WorldState> earlier_;
  double last_truth_ = 0;
  std::map<std::pair<std::string, int>, Sent> sent_;
  RateLimiter warnings_{1.0};
  std::string last_state_;
  int64_t num_frames_ = 0;
  double last_status_ = 0;
  Figures figures_;
};

}  // namespace nao::camera
