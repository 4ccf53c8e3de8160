#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <naolcm/image_t.hpp>

#include "common/channels.h"
#include "common/rate_limiter.h"
#include "common/status_reporter.h"
#include "daemons/vision/pose_history.h"
#include "daemons/vision/vision_core.h"
#include "messages/command_publisher.h"

namespace nao {
class Bus;
class EventLoop;
}  // namespace nao

namespace nao::vision {

struct VisionOptions {
  /** Prefix of the channels. */
  std::string robot = "NAO";
  /** Camera whose images are requested at all times, beside the one that nao-play needs; empty:
   * none. */
  std::string request_camera;
  /** Images a second that are requested. */
  double rate = 15;
  /** The field, and the robot's pose on it when nao-motion starts. Nothing: it is not localised. */
  std::optional<std::pair<FieldModel, Pose2>> field_start;
};

/** Connects VisionCore to the bus: receives NAO_HEAD_CAMERA_IMAGE, NAO_ROBOT_STATE and
 * NAO_PLAY_STATE, publishes NAO_VISION_STATE with each image and NAO_HEAD_CAMERA_COMMAND. Of
 * several images of one camera and time only the first is processed; where images come faster than
 * they are processed, only the newest of each camera. */
class VisionDaemon {
 public:
  /** @param bus, model  Must outlive this. */
  VisionDaemon(Bus& bus, const RobotModel& model, const VisionOptions& options);

  /** Registers message handling, requests and status with the loop. */
  void attach(EventLoop& loop);

  /** Publishes the status, with the figures since the last call. @param now  s, monotonic. */
  void publish_status(double now);

  /** Processes the images that were received since the last call. */
  void process_images();

  int64_t num_images() const { return num_images_; }
  /** Damaged images. */
  int64_t num_refused() const { return num_refused_; }

 private:
  void receive_image(const naolcm::image_t& image);
  /** @throws MessageError  if the image is damaged. */
  void process(const naolcm::image_t& image);
  void request_images();
  void request(const std::string& camera);

  Bus& bus_;
  const RobotModel& model_;
  VisionOptions options_;
  RobotChannels channels_;
  StatusReporter status_;
  CommandPublisher commands_;
  PoseHistory poses_;
  VisionCore core_;
  cv::Mat bgr_;
  /** Robot time of the last image of each camera. */
  std::map<std::string, int64_t> last_image_;
  std::map<std::string, int64_t> last_wide_image_;
  /** Camera that nao-play needs, and when it said so, s, monotonic. */
  std::string play_camera_;
  double last_play_ = -1e9;
  /** Received and not processed yet, by camera. */
  std::map<std::string, naolcm::image_t> waiting_;
  int64_t num_refused_ = 0;
  RateLimiter warnings_{1.0};
  double last_image_time_ = -1e9;
  int64_t num_images_ = 0;
  // Since the last status.
  int num_new_images_ = 0;
  double processing_time_ = 0;
  double last_status_ = 0;
};

}  // namespace nao::vision
