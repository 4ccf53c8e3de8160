#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <naolcm/command_result_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <string>
#include <vector>

#include "common/bus.h"
#include "test/playback/golden_table.h"

namespace nao::playback {

/** Conversions between golden sessions, which are independent of message types, and the messages of
 * this version. Changes of message types are handled only here in the golden tests. */

/** What the robot measured at the tick of a row. */
naolcm::sensor_state_t to_sensor_state(const GoldenTable& table, size_t row);

/** The joint targets of a row, as an answer to the sensors of its tick. */
naolcm::joint_command_t to_joint_command(const GoldenTable& table, size_t row);

/** A recorded command: one line of a file of JSON objects. */
class GoldenCommand {
 public:
  /** @throws Error  if the line has no tick or no type. */
  explicit GoldenCommand(const std::string& line);
  ~GoldenCommand();
  GoldenCommand(GoldenCommand&&) noexcept;

  /** Control tick before whose sensors (motion) or joint command (simulator) it is on the bus. */
  int64_t tick() const { return tick_; }
  /** Publishes it on the channel of its type. @throws Error  if the type is unknown. */
  void publish(Bus& bus) const;

 private:
  struct Fields;
  std::unique_ptr<const Fields> fields_;
  int64_t tick_ = 0;
};

/** All commands of a file, in order of their ticks. @throws Error */
std::vector<GoldenCommand> read_golden_commands(const std::filesystem::path& file);

/** Position and stiffness of each joint, bit by bit, in the recording's order of joints.
 * @throws Error  if one is missing. */
uint64_t hash_of(const naolcm::joint_command_t& message, const std::vector<std::string>& joints);

/** Everything that is measured, bit by bit, in the recording's order of joints. */
uint64_t hash_of(const naolcm::sensor_state_t& message, const std::vector<std::string>& joints);

/** Pose and velocity of the first robot's torso, position, velocity and torque of its joints, pose
 * and velocity of the ball, bit by bit. */
uint64_t hash_of(const naolcm::world_truth_t& message, const std::vector<std::string>& joints);

/** "SOURCE COMMAND_ID COMMAND STATUS", such as "golden 7 move-to done".
 * @throws Error  if the kind of command or the status has no name here. */
std::string to_text(const naolcm::command_result_t& message);

/** Target position of each joint, rad (hands: opening), in the recording's order of joints. */
std::vector<double> targets_of(const naolcm::joint_command_t& message,
                               const std::vector<std::string>& joints);

}  // namespace nao::playback
