#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <naolcm/command_result_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"

namespace nao {

/** A fake of nao-motion, the robot and its camera on the bus: executes every command at once,
 * answers it, and sends images without content. step() and send_image() in the bus's thread, the
 * rest in any. */
class FakeMotion {
 public:
  /** @param robot  Prefix of its channels. */
  FakeMotion(Bus& bus, std::vector<std::string> joint_names, const std::string& robot = "NAO")
      : bus_(bus),
        channels_(robot),
        joint_names_(std::move(joint_names)),
        joint_position_(joint_names_.size()) {
    bus_.subscribe<naolcm::posture_command_t>(
        channels_.posture_command, Bus::Queue::kAll, [this](const auto& command) {
          if (!accept("posture", command.source, command.command_id)) return;
          posture_ = command.posture;
          answer("posture", command.source, command.command_id, "done");
        });
    bus_.subscribe<naolcm::joint_change_command_t>(
        channels_.joint_change_command, Bus::Queue::kAll, [this](const auto& command) {
          if (!accept("joint-change", command.source, command.command_id)) return;
          for (int i = 0; i < command.num_joints; ++i) {
            const auto name =
                std::find(joint_names_.begin(), joint_names_.end(), command.joint_names[i]);
            if (name == joint_names_.end()) continue;
            joint_position_[name - joint_names_.begin()] += command.joint_position[i];
          }
          answer("joint-change", command.source, command.command_id, "done");
        });
    bus_.subscribe<naolcm::stop_command_t>(
        channels_.stop_command, Bus::Queue::kAll, [this](const auto& command) {
          if (!accept("stop", command.source, command.command_id)) return;
          answer("stop", command.source, command.command_id, "done");
        });
    bus_.subscribe<naolcm::walk_command_t>(channels_.walk_command, Bus::Queue::kAll,
                                           [this](const auto& command) {
                                             const std::lock_guard lock(mutex_);
                                             walks_.push_back(command);
                                           });
  }

  /** One tick of 10 ms: sends a robot_state_t, and every tenth time a motion_state_t. */
  void step() {
    ++tick_;
    if (is_silent) return;
    naolcm::robot_state_t state{};
    state.utime = tick_ * 10000;
    state.tick = tick_;
    state.num_joints = static_cast<int>(joint_names_.size());
    state.joint_names = joint_names_;
    state.joint_position = joint_position_;
    state.joint_velocity.assign(joint_names_.size(), 0);
    state.position_torso_in_odometry[2] = 0.3;
    state.orientation_torso_in_odometry[0] = 1;
    bus_.publish(channels_.robot_state, state);
    if (tick_ % 10 != 0) return;
    naolcm::motion_state_t motion{};
    motion.utime = state.utime;
    motion.mode = motion.MODE_HOLDING;
    motion.command_kind = motion.COMMAND_KIND_NONE;
    motion.posture = posture_;
    motion.stiffness = 1;
    bus_.publish(channels_.motion_state, motion);
  }

  /** Sends an image of `size_bytes` bytes that are not a JPEG file. */
  void send_image(int width, int size_bytes) {
    naolcm::image_t image{};
    image.utime = tick_ * 10000;
    image.camera = "top";
    image.width = width;
    image.height = width * 3 / 4;
    image.format = "jpeg";
    image.size_bytes = size_bytes;
    image.data.assign(static_cast<size_t>(size_bytes), 0x5a);
    bus_.publish(channels_.head_camera_image, image);
  }

  std::vector<naolcm::walk_command_t> walks() {
    const std::lock_guard lock(mutex_);
    return walks_;
  }
  /** Kinds of the executed commands, in order. */
  std::vector<std::string> commands() {
    const std::lock_guard lock(mutex_);
    return commands_;
  }

  /** If true, it sends and answers nothing, as after a crash. */
  std::atomic<bool> is_silent = false;

 private:
  /** @return false if this command has been executed before, or is_silent. */
  bool accept(const std::string& command, const std::string& source, int64_t command_id) {
    if (is_silent) return false;
    const std::lock_guard lock(mutex_);
    const auto key = std::make_pair(source, command_id);
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) return false;
    known_.push_back(key);
    commands_.push_back(command);
    answer(command, source, command_id, "accepted");
    return true;
  }

  void answer(const std::string& command, const std::string& source, int64_t command_id,
              const std::string& status) {
    naolcm::command_result_t result{};
    result.utime = tick_ * 10000;
    result.source = source;
    result.command_id = command_id;
    result.command_kind = command == "posture"        ? result.COMMAND_KIND_POSTURE
                          : command == "joint-change" ? result.COMMAND_KIND_JOINT_CHANGE
                                                      : result.COMMAND_KIND_STOP;
    result.status = status == "done" ? result.STATUS_DONE : result.STATUS_ACCEPTED;
    bus_.publish(channels_.command_result, result);
  }

  Bus& bus_;
  RobotChannels channels_;
  std::vector<std::string> joint_names_;
  std::vector<double> joint_position_;
  std::string posture_ = "Stand";
  int64_t tick_ = 0;
  std::vector<std::pair<std::string, int64_t>> known_;
  std::mutex mutex_;
  std::vector<std::string> commands_;
  std::vector<naolcm::walk_command_t> walks_;
};

}  // namespace nao
