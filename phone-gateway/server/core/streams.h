#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "phone-gateway/server/core/component_monitor.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/image_cache.h"
#include "phone-gateway/server/core/robot_mirror.h"
#include "phone-gateway/server/core/robot_sessions.h"

namespace nao::gateway {

/** Camera beside the field, of a simulated world: in no robot's description file. The images are
 * the same for all robots, so that one of them has its program take them for the clients of all. */
inline constexpr const char* kOverviewCamera = "overview";

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

/** Adds a request, or raises rate and quality of one for the same images. */
void merge(const CameraRequest& request, std::vector<CameraRequest>& requests);

/** A piece of what the robot says; speech_audio_t documents every field. */
struct SpeechPiece {
  std::string source;
  int64_t command_id = 0;
  uint32_t sample_rate = 0;
  uint64_t first_sample = 0;
  bool is_last = false;
  /** Signed 16-bit, low byte first. */
  std::string samples;
};

/** Distributes the robot's states and the camera's images to the clients, each at the rate that the
 * client subscribed to. Messages are encoded once and shared. */
class Streams {
 public:
  /** The other objects must outlive this. */
  Streams(const GatewayLimits& limits, const RobotSessions& sessions,
          const ComponentMonitor& components)
      : limits_(limits), sessions_(sessions), components_(components) {}

  void set_robot(const RobotSnapshot& robot, double now);
  void set_motion(const MotionSnapshot& motion);
  /** @param light_rgb  0xRRGGBB, in the order of RobotDescription.lights. */
  void set_lights(std::vector<uint32_t> light_rgb);
  /** None: nothing is known of the robot's body. */
  void set_body(std::optional<naoremote::Body> body);
  void add_image(CachedImage image, double now);
  void add_audio(const SpeechPiece& piece);
  /** A component has become available or unavailable. */
  void handle_component_change() { state_encoding_.reset(); }

  void subscribe(ClientSession& session, const Subscription& subscription) const;

  /** A client that watched another robot watches this one: its subscription goes on, with the first
   * camera if this robot has none of that name. */
  void adopt(ClientSession& session, const naoremote::RobotDescription& robot) const;

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
  /** Whether a client requests images of the robot's own cameras. */
  bool has_image_client(double now) const;

  /** Robot time at `now`, microseconds; 0 if unknown. */
  int64_t calc_robot_utime(double now) const { return mirror_.calc_robot_utime(now); }

  /** The newest states. */
  const RobotMirror& mirror() const { return mirror_; }

  /** Sends the last state once a second while the robot is unavailable, and drops old images. */
  void step(double now);

 private:
  void write_image(const CachedImage& cached, naoremote::Image& image, double now) const;

  GatewayLimits limits_;
  const RobotSessions& sessions_;
  const ComponentMonitor& components_;
  RobotMirror mirror_;
  SharedEncoding state_encoding_;
  /** Memory of the last one, for the next. */
  naoremote::ServerMessage state_message_;
  ImageCache images_;
  /** Command that is being spoken, and the number that clients get of it. */
  std::string speech_source_;
  int64_t speech_command_id_ = 0;
  uint32_t speech_number_ = 0;
  double next_stale_state_ = 0;
};

}  // namespace nao::gateway
