#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <naolcm/camera_command_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "common/bus.h"
#include "common/channels.h"
#include "common/event_loop.h"
#include "common/status_reporter.h"
#include "daemons/head-camera/head_camera.h"
#include "daemons/head-camera/head_camera_options.h"
#include "daemons/head-camera/jpeg_encoder.h"
#include "daemons/head-camera/picture_wishes.h"

namespace nao {

/** Whole image_t message with its picture in it: below the 64 kB of one datagram. */
inline constexpr int kMostMessageBytes = 65000;

/** Message for one size of a frame.
 * @param wish  Width and quality; quality 0 stands for `default_quality`. */
naolcm::image_t encode_image(const CameraFrame& frame, const PictureWish& wish, int default_quality,
                             JpegEncoder& encoder);

/** nao-head-camera's adapter to the bus: takes WORLD_TRUTH and NAO_HEAD_CAMERA_COMMAND, gives
 * NAO_HEAD_CAMERA_IMAGE. Without truth it waits; without a watcher it draws nothing. */
class HeadCameraDaemon {
 public:
  /** Subscribes and draws one picture, since the first one alone takes long.
   * @param bus, model  Must outlive this. */
  HeadCameraDaemon(Bus& bus, const RobotModel& model, const HeadCameraOptions& options);

  /** Takes part in the loop: messages, pictures, status. */
  void attach(EventLoop& loop);

  /** One turn, kFastestRate times a second: takes and sends what is due. @param now  s. */
  void step(double now);

  /** Sends the status of the last second. */
  void publish_status();

  int64_t num_frames() const { return num_frames_; }

 private:
  void receive_truth(const naolcm::world_truth_t& truth);
  void receive_command(const naolcm::camera_command_t& command);
  std::vector<PictureWish> wishes(double now);
  void keep_new(std::vector<PictureWish>& due, double now);
  void send_pictures(const std::string& camera, const std::vector<PictureWish>& due, double now);
  void report_problems();
  /** What is missing for taking pictures, in words; empty if nothing is. */
  std::string lacks(double now) const;
  void update_state(double now, bool is_watched);

  /** Last picture sent of one camera and width. */
  struct Sent {
    int64_t utime;
    double time;
  };

  Bus& bus_;
  const RobotModel& model_;
  HeadCameraOptions options_;
  RobotChannels channels_;
  StatusReporter status_;
  HeadCamera camera_;
  JpegEncoder encoder_;
  PictureWishes watchers_;
  PictureSchedule schedule_;
  std::optional<WorldState> world_;
  /** The state before it. */
  std::optional<WorldState> earlier_;
  double last_truth_ = 0;
  std::map<std::pair<std::string, int>, Sent> sent_;
  RateLimiter warnings_{1.0};
  std::string last_state_;
  int64_t num_frames_ = 0;
  // Since the last status.
  double last_status_ = 0;
  int num_new_frames_ = 0;
  double new_drawing_time_ = 0;
  double largest_message_bytes_ = 0;
};

}  // namespace nao
