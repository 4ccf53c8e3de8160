#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace nao {

/** LoLA's joints: 25, in the order of data/robots/NAME/lola.yaml. */
inline constexpr size_t kLolaJoints = 25;
/** Time between two state frames, s. */
inline constexpr double kLolaPeriod = 0.012;
/** Bytes of a state frame; ids of 20 and versions of 5 characters are part of them. */
inline constexpr size_t kLolaStateBytes = 896;
/** Bytes of a command with every key. */
inline constexpr size_t kLolaCommandBytes = 786;

/** Measurements of the robot, sent every 12 ms, all in LoLA's own units and signs.
 *
 * Source: clients of robot soccer teams (B-Human, HULKs, Nao Devils, rUNSWift, NaoTH, nao_lola),
 * which agree on keys, counts and the size of 896 bytes. The vendor's document names the battery's
 * values in another order than the robot sends them. */
struct LolaState {
  /** rad; the last two are the hands' openings, 0 to 1. */
  std::array<float, kLolaJoints> position{};
  /** Fraction of the servo's torque, 0 to 1. */
  std::array<float, kLolaJoints> stiffness{};
  /** Degrees Celsius, modelled from the current. */
  std::array<float, kLolaJoints> temperature{};
  /** A. */
  std::array<float, kLolaJoints> current{};
  /** 0 normal, 1 hot, 2 stiffness reduced by more than 30 %, 3 stiffness 0. */
  std::array<int, kLolaJoints> status{};
  /** Charge, 0 to 1; status bits; current, A, positive while charging; degrees Celsius. */
  std::array<float, 4> battery{};
  /** x, y, z; m/s^2, minus the specific force: (0, 0, -9.81) at rest. */
  std::array<float, 3> accelerometer{};
  /** x, y, z; rad/s. */
  std::array<float, 3> gyroscope{};
  /** Roll and pitch of the torso, rad. */
  std::array<float, 2> angles{};
  /** Left and right, m. */
  std::array<float, 2> sonar{};
  /** kg. */
  std::array<float, 8> fsr{};
  /** 1 while touched. */
  std::array<float, 14> touch{};
  /** Body id, body version, head id, head version. */
  std::array<std::string, 4> robot_config{};
};

/** Settings by a client. Every key may be left out: the robot then keeps the last value. Lights are
 * 0 to 1. */
struct LolaCommand {
  std::optional<std::array<float, kLolaJoints>> position;
  /** 0 to 1; below 0 is limp, as 0. */
  std::optional<std::array<float, kLolaJoints>> stiffness;
  std::optional<std::array<float, 10>> right_ear;
  std::optional<std::array<float, 10>> left_ear;
  std::optional<std::array<float, 3>> chest;
  /** Eight red values, eight green, eight blue. */
  std::optional<std::array<float, 24>> left_eye;
  std::optional<std::array<float, 24>> right_eye;
  std::optional<std::array<float, 3>> left_foot;
  std::optional<std::array<float, 3>> right_foot;
  std::optional<std::array<float, 12>> skull;
  /** Left and right sonar switched on. */
  std::optional<std::array<bool, 2>> sonar;
};

/** Calls `visit(key, values)` for every key of a state, in the order of the frame. */
template <class State, class Visit>
  requires std::is_same_v<std::remove_const_t<State>, LolaState>
void for_each_field(State& state, Visit&& visit) {
  visit("Position", state.position);
  visit("Stiffness", state.stiffness);
  visit("Temperature", state.temperature);
  visit("Current", state.current);
  visit("Status", state.status);
  visit("Battery", state.battery);
  visit("Accelerometer", state.accelerometer);
  visit("Gyroscope", state.gyroscope);
  visit("Angles", state.angles);
  visit("Sonar", state.sonar);
  visit("FSR", state.fsr);
  visit("Touch", state.touch);
  visit("RobotConfig", state.robot_config);
}

/** Calls `visit(key, optional values)` for every key of a command. */
template <class Command, class Visit>
  requires std::is_same_v<std::remove_const_t<Command>, LolaCommand>
void for_each_field(Command& command, Visit&& visit) {
  visit("Position", command.position);
  visit("Stiffness", command.stiffness);
  visit("REar", command.right_ear);
  visit("LEar", command.left_ear);
  visit("Chest", command.chest);
  visit("LEye", command.left_eye);
  visit("REye", command.right_eye);
  visit("LFoot", command.left_foot);
  visit("RFoot", command.right_foot);
  visit("Skull", command.skull);
  visit("Sonar", command.sonar);
}

/** Calls `visit(values of a, values of b)` for every key of two commands. */
template <class Visit>
void for_each_pair(const LolaCommand& a, LolaCommand& b, Visit&& visit) {
  visit(a.position, b.position);
  visit(a.stiffness, b.stiffness);
  visit(a.right_ear, b.right_ear);
  visit(a.left_ear, b.left_ear);
  visit(a.chest, b.chest);
  visit(a.left_eye, b.left_eye);
  visit(a.right_eye, b.right_eye);
  visit(a.left_foot, b.left_foot);
  visit(a.right_foot, b.right_foot);
  visit(a.skull, b.skull);
  visit(a.sonar, b.sonar);
}

}  // namespace nao
