#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lola/codec.h"

namespace nao {

/** A state in which every value is another one. */
inline LolaState numbered_state() {
  LolaState state;
  float next = 0.5f;
  const auto fill = [&](auto& values) {
    for (auto& value : values) value = next += 1;
  };
  fill(state.position);
  fill(state.stiffness);
  fill(state.temperature);
  fill(state.current);
  for (size_t i = 0; i < state.status.size(); ++i) state.status[i] = static_cast<int>(i % 4);
  fill(state.battery);
  fill(state.accelerometer);
  fill(state.gyroscope);
  fill(state.angles);
  fill(state.sonar);
  fill(state.fsr);
  fill(state.touch);
  state.robot_config = {"P0000000A00S00000001", "6.0.0", "P0000000A00S00000002", "6.0.1"};
  return state;
}

/** A command with every key, in which every value is another one. */
inline LolaCommand numbered_command() {
  LolaCommand command;
  float next = 0;
  const auto fill = [&](auto& values) {
    for (auto& value : values.emplace()) value = next += 0.25f;
  };
  fill(command.position);
  fill(command.stiffness);
  fill(command.right_ear);
  fill(command.left_ear);
  fill(command.chest);
  fill(command.left_eye);
  fill(command.right_eye);
  fill(command.left_foot);
  fill(command.right_foot);
  fill(command.skull);
  command.sonar = {true, false};
  return command;
}

template <class Message>
std::vector<uint8_t> encoded(const Message& message) {
  std::array<uint8_t, 4096> memory;
  const size_t size = encode(message, memory);
  return {memory.begin(), memory.begin() + static_cast<long>(size)};
}

}  // namespace nao
