#pragma once

#include <string>
#include <variant>

#include "phone-gateway/server/gateway_limits.h"
#include "phone-gateway/server/motion_command.h"
#include "phone-gateway/server/phone_robot.h"
#include "remote.pb.h"

namespace nao {

/** What is wrong with a request, as a sentence for a person. */
struct Refusal {
  std::string message;
};

/** Turns a phone's motion request into a command, checking every field: finite, in range, naming
 * something that the robot has. One function for each use case that moves the robot. */
[[nodiscard]] std::variant<WalkVelocity, Refusal> check(const naoremote::WalkTurn& request,
                                                        const PhoneRobot& robot);
[[nodiscard]] std::variant<MotionCommand, Refusal> check(const naoremote::MoveTo& request);
[[nodiscard]] std::variant<MotionCommand, Refusal> check(const naoremote::GoToPosture& request,
                                                         const PhoneRobot& robot);
[[nodiscard]] std::variant<MotionCommand, Refusal> check(const naoremote::ChangeJoints& request,
                                                         const PhoneRobot& robot);
[[nodiscard]] std::variant<MotionCommand, Refusal> check(const naoremote::DoAction& request,
                                                         const PhoneRobot& robot);

/** Which image a client wishes for, checked, with the defaults filled in. */
struct ImageSelection {
  std::string camera;
  uint32_t width = 320;
  /** JPEG quality, 1 to 95; 0 leaves it to the camera. */
  uint32_t quality = 0;

  bool shows_same(const ImageSelection& other) const {
    return camera == other.camera && width == other.width;
  }
};

[[nodiscard]] std::variant<ImageSelection, Refusal> check(const naoremote::ImageRequest& request,
                                                          const PhoneRobot& robot);

/** A checked Subscribe. Rates in 1/s. */
struct Subscription {
  double state_rate = 0;
  double image_rate = 0;
  ImageSelection image;
};

[[nodiscard]] std::variant<Subscription, Refusal> check(const naoremote::Subscribe& request,
                                                        const PhoneRobot& robot,
                                                        const GatewayLimits& limits);

}  // namespace nao
