#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "messages/command_publisher.h"
#include "phone-gateway/server/bus/bus_messages.h"
#include "phone-gateway/server/core/gateway_robot.h"

namespace nao::gateway {

/** The channels of one robot: publishes the commands for it, and passes its messages to its part of
 * the gateway's core.
 *
 * With the robot's name in place of NAO it reads NAO_ROBOT_STATE, NAO_MOTION_STATE,
 * NAO_BODY_STATE, NAO_COMMAND_RESULT, NAO_HEAD_CAMERA_IMAGE, NAO_SPEECH_AUDIO,
 * NAO_MOTION_FILE_RESULT, NAO_VISION_STATE and NAO_PLAY_STATE; it writes the NAO_..._COMMAND
 * channels of walk, move-to, posture, joint change, action, stop, motion file, speech, lights, play
 * and head camera, and WORLD_COMMAND for the drag of a simulated robot. */
class RobotLink {
 public:
  /** @param source  Of the gateway's commands; results for other sources are ignored.
   * The bus must outlive this. */
  RobotLink(Bus& bus, const naoremote::RobotDescription& robot, std::string source);
  // Its publisher refers to its channels.
  RobotLink(const RobotLink&) = delete;
  RobotLink& operator=(const RobotLink&) = delete;

  /** The robot for the gateway's core. This must outlive the core. */
  RobotSetup setup();

  /** Passes received messages to `robot`, which must outlive this, and images to `add_image`. */
  void subscribe(GatewayRobot& robot, const std::function<void(CachedImage)>& add_image);

  /** Publishes image requests. @param always  Also unchanged ones. */
  void send_camera_requests(std::vector<CameraRequest> requests, bool always);

  /** Channel whose messages show that the robot's motion program runs. */
  const std::string& motion_state_channel() const { return channels_.motion_state; }

 private:
  void subscribe_perception(GatewayRobot& robot, const std::function<void(CachedImage)>& add_image);
  void send_drag(const DragCommand& drag);
  void send_service(const ServiceCommand& command);
  void send_play(const SentPlayCommand& command);

  Bus& bus_;
  naoremote::RobotDescription description_;
  std::string source_;
  RobotChannels channels_;
  int64_t last_drag_id_;
  CommandPublisher commands_;
  RobotStateReader robot_state_reader_;
  naolcm::robot_state_t robot_state_;
  std::vector<CameraRequest> last_requests_;
  ImageSizes image_sizes_;
};

}  // namespace nao::gateway
