#pragma once

#include <vector>

#include "phone-gateway/server/core/component_monitor.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/image_cache.h"
#include "phone-gateway/server/core/robot_mirror.h"
#include "phone-gateway/server/core/sessions.h"

namespace nao::gateway {

/** Images that the camera must send. */
struct CameraRequest {
  ImageSelection image;
  /** 1/s, the highest rate of all clients that share the images. */
  double rate = 0;

  bool operator==(const CameraRequest& other) const {
    return image.is_same_stream(other.image) && image.quality == other.image.quality &&
           rate == other.rate;
  }
};

/** Distributes the robot's states and the camera's images to the clients, each at the rate that the
 * client subscribed to. Messages are encoded once and shared. */
class Streams {
 public:
  /** The other objects must outlive this. */
  Streams(const GatewayLimits& limits, const Sessions& sessions, const ComponentMonitor& components)
      : limits_(limits), sessions_(sessions), components_(components) {}

  void set_robot(const RobotSnapshot& robot, double now);
  void set_motion(const MotionSnapshot& motion);
  void add_image(CachedImage image, double now);
  /** A component has become available or unavailable. */
  void handle_component_change() { state_encoding_.reset(); }

  void subscribe(ClientSession& session, const Subscription& subscription) const;

  /** Answers a GetState.
   * @param selection  The images that the client polls; nullptr: none.
   * @return false if no state has been received yet. */
  bool get(ClientSession& session, const ImageSelection* selection, double now,
           naoremote::StateAndImage& result);

  /** The newest state or image for a client, as a message; null if there is none (for images: none
   * that the client has not received). */
  MessageBytes make_state_message(double now);
  MessageBytes make_image_message(ClientSession& session, double now);

  /** The images that clients request now. */
  std::vector<CameraRequest> camera_requests(double now) const;

  /** Robot time at `now`, microseconds; 0 if unknown. */
  int64_t calc_robot_utime(double now) const { return mirror_.calc_robot_utime(now); }

  /** Sends the last state once a second while the robot is unavailable, and drops old images. */
  void step(double now);

 private:
  void write_image(const CachedImage& cached, naoremote::Image& image, double now) const;

  GatewayLimits limits_;
  const Sessions& sessions_;
  const ComponentMonitor& components_;
  RobotMirror mirror_;
  SharedEncoding state_encoding_;
  ImageCache images_;
  double next_stale_state_ = 0;
};

}  // namespace nao::gateway
