#include "test/playback/frozen_log.h"

#include <naolcm/action_command_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/move_to_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "common/error.h"

namespace nao::playback {
namespace {

/** @return false if the bytes are not such a message. */
template <class Message>
bool send_as(Bus& bus, const LogEvent& event) {
  Message message;
  const int size = static_cast<int>(event.data.size());
  if (message.decode(event.data.data(), 0, size) != size) return false;
  bus.publish(event.channel, message);
  return true;
}

}  // namespace

std::vector<LogEvent> read_frozen_log(const std::filesystem::path& file) {
  LogReader reader(file);
  std::vector<LogEvent> events;
  while (auto event = reader.next()) events.push_back(std::move(*event));
  if (events.empty()) throw Error(file.string() + " holds no message");
  return events;
}

void send(Bus& bus, const LogEvent& event) {
  if (send_as<naolcm::walk_command_t>(bus, event) ||
      send_as<naolcm::move_to_command_t>(bus, event) ||
      send_as<naolcm::posture_command_t>(bus, event) ||
      send_as<naolcm::joint_change_command_t>(bus, event) ||
      send_as<naolcm::action_command_t>(bus, event) ||
      send_as<naolcm::stop_command_t>(bus, event) || send_as<naolcm::world_command_t>(bus, event) ||
      send_as<naolcm::sensor_state_t>(bus, event) || send_as<naolcm::world_truth_t>(bus, event)) {
    return;
  }
  throw Error(
      "a message on " + event.channel +
      " is of no type that is played back, or its type has changed since the log was frozen. "
      "Record it again: test/playback/record");
}

}  // namespace nao::playback
