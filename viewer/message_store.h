#pragma once

#include <cstdint>
#include <deque>
#include <map>
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

namespace nao {

/** A message and when it came, s of the viewer's time line. */
template <class Message>
struct Received {
  Message message;
  double time = 0;
};

/** What the viewer knows: the newest message of each kind, whether from the bus or from a log. */
class MessageStore {
 public:
  /** @param robot  Name of the robot shown, the prefix of its channels. */
  explicit MessageStore(const std::string& robot) : channels_(robot) {}

  /** Takes one message. @return false if it does not decode as its channel's type. */
  bool receive(const std::string& channel, const uint8_t* data, int num_bytes, double time);

  /** Forgets everything. */
  void clear();

  const RobotChannels& channels() const { return channels_; }

  const std::optional<Received<naolcm::robot_state_t>>& robot_state() const { return robot_state_; }
  const std::optional<Received<naolcm::motion_state_t>>& motion_state() const {
    return motion_state_;
  }
  const std::optional<Received<naolcm::world_truth_t>>& truth() const { return truth_; }
  const std::optional<Received<naolcm::image_t>>& image() const { return image_; }
  /** Newest last, 100 at most. */
  const std::deque<Received<naolcm::command_result_t>>& results() const { return results_; }
  /** By program and process. */
  const std::map<std::string, Received<naolcm::daemon_status_t>>& programs() const {
    return programs_;
  }
  /** Newest raw message of every channel, for looking at its fields. */
  const std::map<std::string, std::vector<uint8_t>>& raw() const { return raw_; }

 private:
  RobotChannels channels_;
  std::optional<Received<naolcm::robot_state_t>> robot_state_;
  std::optional<Received<naolcm::motion_state_t>> motion_state_;
  std::optional<Received<naolcm::world_truth_t>> truth_;
  std::optional<Received<naolcm::image_t>> image_;
  std::deque<Received<naolcm::command_result_t>> results_;
  std::map<std::string, Received<naolcm::daemon_status_t>> programs_;
  std::map<std::string, std::vector<uint8_t>> raw_;
};

}  // namespace nao
