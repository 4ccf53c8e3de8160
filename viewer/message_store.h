#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <naolcm/body_state_t.hpp>
#include <naolcm/command_result_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/channels.h"

namespace nao::viewer {

/** A message and the time of its reception, s: monotonic, or since the start of the log. */
template <class Message>
struct Received {
  Message message;
  double time = 0;
};

/** The newest messages of each type, from the bus or from a log. Its header includes the message
 * types: include it in .cpp files only. */
class MessageStore {
 public:
  /** @param robot  Name of the robot shown, the prefix of its channels. */
  explicit MessageStore(const std::string& robot) : channels_(robot) {}

  /** Stores one message. @return false if it does not decode as the type of its channel. */
  bool receive(const std::string& channel, const uint8_t* data, int num_bytes, double time);

  /** Removes all messages. */
  void clear();

  const RobotChannels& channels() const { return channels_; }

  const std::optional<Received<naolcm::robot_state_t>>& robot_state() const { return robot_state_; }
  const std::optional<Received<naolcm::motion_state_t>>& motion_state() const {
    return motion_state_;
  }
  const std::optional<Received<naolcm::body_state_t>>& body_state() const { return body_state_; }
  const std::optional<Received<naolcm::world_truth_t>>& truth() const { return truth_; }
  const std::optional<Received<naolcm::image_t>>& image() const { return image_; }
  /** The last 100 results without repetitions, newest last. */
  const std::deque<Received<naolcm::command_result_t>>& results() const { return results_; }
  /** By program and process. */
  const std::map<std::string, Received<naolcm::daemon_status_t>>& programs() const {
    return programs_;
  }
  /** The newest encoded message of each channel. */
  const std::map<std::string, std::vector<uint8_t>>& raw() const { return raw_; }

 private:
  bool receive_result(const uint8_t* data, int num_bytes, double time);
  bool receive_status(const uint8_t* data, int num_bytes, double time);

  RobotChannels channels_;
  std::optional<Received<naolcm::robot_state_t>> robot_state_;
  std::optional<Received<naolcm::motion_state_t>> motion_state_;
  std::optional<Received<naolcm::body_state_t>> body_state_;
  std::optional<Received<naolcm::world_truth_t>> truth_;
  std::optional<Received<naolcm::image_t>> image_;
  std::deque<Received<naolcm::command_result_t>> results_;
  std::map<std::string, Received<naolcm::daemon_status_t>> programs_;
  std::map<std::string, std::vector<uint8_t>> raw_;
};

}  // namespace nao::viewer
