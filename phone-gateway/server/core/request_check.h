#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "messages/command.h"
#include "messages/light_command.h"
#include "messages/play_command.h"
#include "messages/speech_command.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "remote.pb.h"

namespace nao::gateway {

// Each function checks every field of one use case: finite, in range, naming something that the
// robot has. The result is safe to send to the program that executes it.

/** Clips the velocity to the robot's limits. */
[[nodiscard]] std::variant<WalkCommand, Refusal> check(const naoremote::WalkTurn& request,
                                                       const naoremote::RobotDescription& robot);
[[nodiscard]] std::variant<MoveToCommand, Refusal> check(const naoremote::MoveTo& request);
[[nodiscard]] std::variant<PostureCommand, Refusal> check(const naoremote::GoToPosture& request,
                                                          const naoremote::RobotDescription& robot);
/** Maps group and axes to joints. */
[[nodiscard]] std::variant<JointChangeCommand, Refusal> check(
    const naoremote::ChangeJoints& request, const naoremote::RobotDescription& robot);
[[nodiscard]] std::variant<ActionCommand, Refusal> check(const naoremote::DoAction& request,
                                                         const naoremote::RobotDescription& robot);

[[nodiscard]] std::variant<SpeechCommand, Refusal> check(const naoremote::Say& request);
[[nodiscard]] std::variant<LightCommand, Refusal> check(const naoremote::SetLights& request,
                                                        const naoremote::RobotDescription& robot);

[[nodiscard]] std::variant<PlayCommand, Refusal> check(const naoremote::Play& request);

/** JPEG quality of a request, 0 being the camera's default. */
inline uint32_t effective_quality(uint32_t quality) {
  // nao-head-camera's default.
  return quality == 0 ? 80 : quality;
}

/** The images that a client requests: checked, with the defaults filled in. */
struct ImageSelection {
  std::string camera;
  /** Pixels. */
  uint32_t width = 320;
  /** JPEG quality, 1 to 95; 0: the camera's default. */
  uint32_t quality = 0;

  /** Whether the same images serve both, apart from their quality. */
  bool is_same_stream(const ImageSelection& other) const {
    return camera == other.camera && width == other.width;
  }
};

[[nodiscard]] std::variant<ImageSelection, Refusal> check(const naoremote::ImageRequest& request,
                                                          const naoremote::RobotDescription& robot);

/** A checked Subscribe. Rates in 1/s. */
struct Subscription {
  double state_rate = 0;
  double image_rate = 0;
  ImageSelection image;
  /** What the robot says. */
  bool has_audio = false;
  /** What nao-play does, and what nao-vision sees. */
  bool has_play_state = false;
  bool has_vision = false;
};

[[nodiscard]] std::variant<Subscription, Refusal> check(const naoremote::Subscribe& request,
                                                        const naoremote::RobotDescription& robot,
                                                        const GatewayLimits& limits);

}  // namespace nao::gateway
