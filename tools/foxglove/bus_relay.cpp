#include "tools/foxglove/bus_relay.h"

#include <utility>

#include "inspection/foxglove_schemas.h"
#include "inspection/message_json.h"
#include "message_reflection/message_types.h"

namespace nao::foxglove {
namespace {

// Bound of memory. Chosen: far more than ten robots have.
constexpr size_t kMaxBusChannels = 1000;

}  // namespace

BusRelay::BusRelay(ServerCore& core, FoxgloveConverter& converter)
    : core_(core), converter_(converter) {
  for (const FoxgloveConverter::Output& output : converter.outputs()) {
    outputs_.push_back(
        core.add_channel(output.topic, output.schema, foxglove_schema(output.schema)));
  }
  core.on_subscribe([this](uint32_t client, uint32_t number) { send_last(client, number); });
}

void BusRelay::receive(const std::string& name, std::span<const uint8_t> message,
                       int64_t wall_utime) {
  const MessageType* type = find_message_type(message.data(), static_cast<int>(message.size()));
  if (type == nullptr || (!channels_.contains(name) && channels_.size() >= kMaxBusChannels)) {
    ++num_undecodable_;
    return;
  }
  BusChannel& channel = channels_[name];
  if (channel.layout == nullptr || channel.layout->name != type->name) {
    channel.layout = find_message_layout(type->name);
    channel.number =
        core_.add_channel(name, "naolcm." + type->name, json_schema_of(*channel.layout));
  }
  channel.message.assign(message.begin(), message.end());
  channel.wall_utime = wall_utime;
  if (core_.has_subscribers(channel.number)) {
    if (auto json = message_to_json(*channel.layout, message)) {
      core_.publish(channel.number, wall_utime, std::move(*json));
    } else {
      ++num_undecodable_;
    }
  }
  converter_.convert(
      name, message, [this](size_t output) { return core_.has_subscribers(outputs_[output]); },
      [&](size_t output, std::string json) {
        core_.publish(outputs_[output], wall_utime, std::move(json));
      });
}

void BusRelay::send_last(uint32_t client, uint32_t number) {
  for (const auto& [name, channel] : channels_) {
    if (channel.number != number) continue;
    if (auto json = message_to_json(*channel.layout, channel.message)) {
      core_.publish_to(client, number, channel.wall_utime, std::move(*json));
    }
  }
}

std::set<std::string> BusRelay::wanted_cameras() const {
  std::set<std::string> cameras;
  for (size_t i = 0; i < outputs_.size(); ++i) {
    const CameraModel* camera = converter_.camera_of(i);
    if (camera != nullptr && core_.has_subscribers(outputs_[i])) cameras.insert(camera->name);
  }
  return cameras;
}

}  // namespace nao::foxglove
