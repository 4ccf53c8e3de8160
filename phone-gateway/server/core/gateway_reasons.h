#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "messages/reason.h"
#include "messages/reason_table.h"
#include "remote.pb.h"

namespace nao::gateway {

// clang-format off
/** Reasons of the gateway itself, in addition to those of messages/reason_table.h. */
inline constexpr auto kGatewayReasons = std::to_array<ReasonEntry>({
    // Requests.
    {"not-a-request", "", "The bytes are no Request message."},
    {"use-case-unknown", "", "The request has no use case that this gateway knows."},
    {"too-many-requests", "limit", "More than {0} requests in a second."},
    {"not-connected", "", "Send Connect first."},
    // Connect.
    {"already-connected", "", "This client is connected already."},
    {"protocol-version-unsupported", "version, supported version", "Protocol version {0} is not supported; this gateway speaks version {1}."},
    {"token-wrong", "", "The token is wrong or missing; open the address that the gateway printed, or scan its QR code."},
    {"too-many-wrong-tokens", "seconds", "Too many wrong tokens; wait {0} s."},
    {"too-many-clients", "limit", "{0} clients are connected already."},
    {"too-many-clients-of-address", "limit", "{0} clients of this address are connected already."},
    // Values of requests.
    {"goal-out-of-range", "metres, radians", "x and y of the goal must be within {0} m, theta within {1} rad."},
    {"joint-group-unknown", "group, known groups", "The robot has no joint group {0}; it has {1}."},
    {"axis-missing", "group, axis", "The joint group {0} has no {1} axis."},
    {"joint-change-out-of-range", "axis, radians, limit", "The {0} change {1} rad is outside [-{2}, {2}]."},
    {"joint-change-zero", "", "The change is zero about every axis."},
    {"ball-incomplete", "", "ball_x and ball_y must be given together."},
    {"ball-out-of-range", "metres", "ball_x and ball_y must be within {0} m."},
    {"target-incomplete", "", "target_x and target_y must be given together."},
    {"camera-unknown", "camera, known cameras", "The robot has no camera {0}; it has {1}."},
    {"width-unsupported", "pixels", "Image width {0} is none of 640, 320 and 160 pixels."},
    {"quality-out-of-range", "quality", "JPEG quality {0} is outside [0, 95]."},
    {"state-rate-out-of-range", "rate, limit", "State rate {0} is outside [0, {1}] a second."},
    {"image-rate-out-of-range", "rate, limit", "Image rate {0} is outside [0, {1}] a second."},
    {"light-lists-unequal", "lights, colors", "There are {0} light names, but {1} colors."},
    {"stiffness-out-of-range", "stiffness", "Stiffness {0} is outside [0, 1]."},
    {"link-invalid", "", "The name of the link is empty or too long."},
    {"drag-out-of-range", "metres, metres", "The point must be within {0} m of the link's origin, the target within {1} m of the torso's."},
    {"not-simulated", "", "Only a simulated robot can be dragged."},
    {"motion-files-unavailable", "", "The program that keeps the taught motions does not answer."},
    {"motion-files-busy", "", "Other motions of this client are still being checked."},
    {"operation-unknown", "", "The operation is none of LIST, TAKE, RELEASE, KICK, MUTE, UNMUTE and ASSIGN."},
    {"operator-only", "", "Only the gateway's own host may send Operate."},
    {"client-unknown", "client", "No client has the number {0}."},
    {"client-muted", "client", "{0} may only watch; let it drive first."},
    {"robot-unknown", "robot, known robots", "The gateway has no robot {0}; it has {1}."},
    // Control.
    {"no-driver", "", "No client has control; take control first."},
    {"command-too-late", "seconds, limit", "The command came {0} s late; up to {1} s are allowed."},
    {"link-too-slow", "seconds", "The connection is too slow to walk: an answer takes {0} s."},
    {"control-taken", "driver", "{0} has control."},
    {"walk-stopped", "", "Stopped; release the joystick before walking again."},
    {"walk-link-lost", "seconds", "The walk has ended: for {0} s nothing came over the connection."},
    {"driver-changed", "driver", "{0} has control now."},
    {"control-released", "client", "{0} released control; no client has control."},
    {"control-asked", "client", "{0} asks for control."},
    {"control-ask-withdrawn", "client", "{0} no longer asks for control."},
    {"driver-disconnected", "client", "{0} disconnected; no client has control."},
    {"driver-left", "client, robot", "{0} changed to {1}; no client has control."},
    {"muted-by-operator", "", "The operator lets this client watch only."},
    {"unmuted-by-operator", "", "The operator lets this client drive again."},
    {"robot-changed", "robot", "This client watches {0} now."},
    // Exhibition.
    {"exhibition-none", "", "There is no exhibition here."},
    {"exhibition-queue", "", "Visitors drive in turn: wait in the queue."},
    {"exhibition-full", "", "The queue is full; try again later."},
    {"exhibition-forbidden", "what", "{0} is not allowed here."},
    {"exhibition-fence", "", "The goal is outside the fence."},
    {"exhibition-key-invalid", "", "The visitor's key must have 16 to 64 bytes."},
    {"exhibition-secret-wrong", "", "The operator's secret is wrong; open the address that scripts/start printed."},
    {"exhibition-value-invalid", "value", "{0} is out of range."},
    // Components.
    {"motion-unavailable", "", "The robot's motion program does not answer."},
    {"motion-available", "", "The robot's motion program answers again."},
    {"robot-unavailable", "", "The robot does not answer."},
    {"robot-available", "", "The robot answers again."},
    {"camera-unavailable", "", "The head camera sends no images."},
    {"camera-available", "", "The head camera sends images again."},
    {"no-state-yet", "", "No state of the robot has been received yet."},
    // Results of commands.
    {"command-done", "command", "{0}: done."},
    {"command-unanswered", "seconds", "The robot's motion program did not answer the command within {0} s."},
    {"speech-unanswered", "seconds", "The robot's speech program did not answer within {0} s."},
    {"play-unanswered", "seconds", "The robot's play program did not answer within {0} s."},
    {"lights-unanswered", "seconds", "The robot did not answer the light command within {0} s."},
    // Closing of a connection.
    {"connect-timeout", "seconds", "No Connect within {0} s."},
    {"silence-timeout", "seconds", "No request for {0} s."},
    {"messages-not-read", "limit", "More than {0} messages wait to be read."},
    {"too-many-malformed-requests", "limit", "More than {0} messages were no Request."},
    {"message-too-long", "bytes", "A message is longer than {0} bytes."},
    {"connection-replaced", "", "The client has opened another second connection."},
    {"connection-ended", "", "The client's first connection has ended."},
    {"invitation-ended", "", "This invitation has expired or was withdrawn."},
    {"relay-message-refused", "fault", "A message was refused: {0}"},
    {"text-message", "", "Messages must be sent as binary messages."},
    {"closed-by-operator", "", "The operator closed this connection."},
    {"gateway-stopping", "", "The gateway stops."},
});
// clang-format on

/** @return Index in kGatewayReasons; its size if there is no such code. */
constexpr size_t find_gateway_reason(std::string_view code) {
  for (size_t i = 0; i < kGatewayReasons.size(); ++i) {
    if (kGatewayReasons[i].code == code) return i;
  }
  return kGatewayReasons.size();
}

/** A code of kGatewayReasons. Any other text does not compile. */
class GatewayReasonCode {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): written as gateway_reason("not-connected").
  consteval GatewayReasonCode(const char* code) : code_(code) {
    if (find_gateway_reason(code) == kGatewayReasons.size())
      throw "no such code in kGatewayReasons";
  }
  std::string text() const { return std::string(code_); }

 private:
  std::string_view code_;
};

/** A reason of the gateway. @param arguments  In the order of the table. */
Reason gateway_reason(GatewayReasonCode code, std::vector<std::string> arguments = {});

/** English sentence for a reason of the gateway or of messages/reason_table.h. */
std::string describe_reason(const Reason& reason);

/** Sets `message`, `reason_code` and `reason_arguments` of a Response or Notice. */
template <class Message>
void write_reason(const Reason& reason, Message& message) {
  message.set_message(describe_reason(reason));
  message.set_reason_code(reason.code);
  message.mutable_reason_arguments()->Assign(reason.arguments.begin(), reason.arguments.end());
}

/** Why a request is refused. */
struct Refusal {
  naoremote::ErrorCode error = naoremote::INVALID_ARGUMENT;
  Reason reason;
};

}  // namespace nao::gateway
