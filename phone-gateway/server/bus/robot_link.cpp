#include "phone-gateway/server/bus/robot_link.h"

#include <algorithm>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <utility>

#include "common/error.h"
#include "common/wall_clock.h"

namespace nao::gateway {

RobotLink::RobotLink(Bus& bus, const naoremote::RobotDescription& robot, std::string source)
    : bus_(bus),
      description_(robot),
      source_(std::move(source)),
      channels_(robot.name()),
      last_drag_id_(wall_utime()),
      commands_(bus_, channels_),
      robot_state_reader_(robot) {}

RobotSetup RobotLink::setup() {
  return {description_,
          {[this](const Command& command) { commands_.publish(command); },
           [this](const ServiceCommand& command) { send_service(command); },
           [this](const MotionFileCommand& command) {
             commands_.publish(channels_.motion_file_command, to_message(command), command.source,
                               command.id);
           },
           [this](const DragCommand& drag) { send_drag(drag); },
           [this](const SentPlayCommand& command) { send_play(command); }}};
}

void RobotLink::subscribe(GatewayRobot& robot, const std::function<void(CachedImage)>& add_image) {
  // The most frequent one: the memory of its lists is used again.
  bus_.subscribe_encoded(
      channels_.robot_state, Bus::Queue::kLatest, [this, &robot](const RawMessage& raw) {
        if (!decode_message(raw.bytes, robot_state_)) throw MessageError("it is damaged");
        robot.set_state(robot_state_reader_.read(robot_state_), monotonic_seconds());
      });
  bus_.subscribe<naolcm::motion_state_t>(
      channels_.motion_state, Bus::Queue::kLatest, [&robot](const auto& message) {
        robot.set_motion(read_motion_state(message), monotonic_seconds());
      });
  bus_.subscribe<naolcm::command_result_t>(
      channels_.command_result, Bus::Queue::kAll, [this, &robot](const auto& message) {
        // Other programs send commands, too.
        if (message.source.starts_with(source_)) {
          robot.handle_result(read_result(message), monotonic_seconds());
        }
      });
  bus_.subscribe<naolcm::body_state_t>(
      channels_.body_state, Bus::Queue::kLatest, [this, &robot](const auto& message) {
        robot.streams().set_lights(read_lights(message, description_));
        robot.streams().set_body(read_body(message, description_));
      });
  bus_.subscribe<naolcm::motion_file_result_t>(
      channels_.motion_file_result, Bus::Queue::kAll, [&robot](const auto& message) {
        const auto result = from_message(message);
        if (!result) throw MessageError("the lists of its motion have unequal lengths");
        robot.motions().handle_result(*result, monotonic_seconds());
      });
  subscribe_perception(robot, add_image);
}

void RobotLink::subscribe_perception(GatewayRobot& robot,
                                     const std::function<void(CachedImage)>& add_image) {
  bus_.subscribe<naolcm::speech_audio_t>(
      channels_.speech_audio, Bus::Queue::kAll,
      [&robot](const auto& message) { robot.streams().add_audio(read_audio(message)); });
  // The channel carries several sizes: with kLatest one would replace another.
  bus_.subscribe<naolcm::image_t>(channels_.head_camera_image, Bus::Queue::kAll,
                                  [this, add_image](const auto& message) {
                                    image_sizes_.add(message);
                                    add_image(read_image(message));
                                  });
  bus_.subscribe<naolcm::vision_state_t>(
      channels_.vision_state, Bus::Queue::kLatest, [this, &robot](const auto& message) {
        robot.perception().set(read_vision(message, image_sizes_));
      });
  bus_.subscribe<naolcm::play_state_t>(
      channels_.play_state, Bus::Queue::kLatest,
      [&robot](const auto& message) { robot.set_play_state(read_play_state(message)); });
}

void RobotLink::send_service(const ServiceCommand& command) {
  const bool is_speech = std::holds_alternative<SpeechCommand>(command.request);
  std::visit(
      [&](const auto& request) {
        commands_.publish(is_speech ? channels_.speech_command : channels_.light_command,
                          to_message(request), command.source, command.id);
      },
      command.request);
}

void RobotLink::send_play(const SentPlayCommand& command) {
  commands_.publish(channels_.play_command, to_message(command.command), command.source,
                    command.id);
}

void RobotLink::send_drag(const DragCommand& drag) {
  naolcm::world_command_t message{};
  message.command = "drag-in-torso";
  message.robot = description_.name();
  message.link = drag.link;
  std::copy_n(drag.point, 3, message.point_in_link);
  std::copy_n(drag.target, 3, message.target_in_world);
  commands_.publish(kWorldCommandChannel, message, source_, ++last_drag_id_);
}

void RobotLink::send_camera_requests(std::vector<CameraRequest> requests, bool always) {
  if (!always && requests == last_requests_) return;
  last_requests_ = std::move(requests);
  for (const CameraRequest& request : last_requests_) {
    naolcm::camera_command_t message{};
    message.camera = request.image.camera;
    message.width = static_cast<int32_t>(request.image.width);
    // camera_command_t allows rates from 1/s on.
    message.rate = std::max(1.0, request.rate);
    message.quality = static_cast<int32_t>(request.image.quality);
    commands_.publish(channels_.head_camera_command, message, source_);
  }
}

}  // namespace nao::gateway
