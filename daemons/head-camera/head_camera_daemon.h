#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <naolcm/image_t.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/channels.h"
#include "common/rate_limiter.h"
#include "common/status_reporter.h"
#include "daemons/head-camera/head_camera_options.h"
#include "daemons/head-camera/image_requests.h"
#include "daemons/head-camera/image_source.h"
#include "daemons/head-camera/jpeg_encoder.h"
#include "daemons/head-camera/webots_images.h"

namespace naolcm {
class camera_command_t;
}  // namespace naolcm

namespace nao {
class Bus;
class EventLoop;
}  // namespace nao

namespace nao::camera {

/** Connects an ImageSource to the bus: receives NAO_HEAD_CAMERA_COMMAND, publishes
 * NAO_HEAD_CAMERA_IMAGE. It takes images only while a request is valid. */
class HeadCameraDaemon {
 public:
  /** Makes the source that the options name, and subscribes.
   * @param bus, model  Must outlive this. @throws Error  if the source is not available. */
  HeadCameraDaemon(Bus& bus, const RobotModel& model, const HeadCameraOptions& options);

  /** Registers message handling, images and status with the loop. */
  void attach(EventLoop& loop);

  /** One step of all cameras, to be called kMaxRate times a second: takes and publishes the images
   * that are due. @param now  s, monotonic. */
  void step(double now);

  /** Publishes the status, with the figures since the last call. */
  void publish_status();

  /** Images taken since the start. */
  int64_t num_frames() const { return num_frames_; }

 private:
  /** The same for one camera. */
  void step(const std::string& camera, double now);
  void receive_command(const naolcm::camera_command_t& command);
  std::vector<ImageRequest> valid_requests(double now);
  /** Removes the requests whose last image already shows the current state. */
  void remove_unchanged(std::vector<ImageRequest>& due, double now);
  void send_images(const std::string& camera, const std::vector<ImageRequest>& due, double now);
  void report_problems();
  void update_state(double now, bool has_requests);

  /** The last image published of one camera and width. */
  struct Sent {
    naolcm::image_t image;
    /** Of the frame that it shows. */
    int64_t num_changes = -1;
    /** As requested. */
    int quality = 0;
    /** Robot time of the state. */
    int64_t utime = 0;
    /** s, monotonic. */
    double time = 0;
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
  std::unique_ptr<ImageSource> source_;
  std::vector<CameraModel> cameras_;
  std::optional<WebotsImages> webots_;
  JpegEncoder encoder_;
  ImageRequests requests_;
  /** By camera. */
  std::map<std::string, ImageSchedule> schedules_;
  std::map<std::pair<std::string, int>, Sent> sent_;
  RateLimiter warnings_{1.0};
  std::string last_state_;
  int64_t num_frames_ = 0;
  double last_status_ = 0;
  Figures figures_;
};

}  // namespace nao::camera
