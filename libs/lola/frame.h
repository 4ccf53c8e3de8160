#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

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

/** Keys and members, in the order of the frame. */
inline constexpr auto kLolaStateFields = std::tuple(
    std::pair("Position", &LolaState::position), std::pair("Stiffness", &LolaState::stiffness),
    std::pair("Temperature", &LolaState::temperature), std::pair("Current", &LolaState::current),
    std::pair("Status", &LolaState::status), std::pair("Battery", &LolaState::battery),
    std::pair("Accelerometer", &LolaState::accelerometer),
    std::pair("Gyroscope", &LolaState::gyroscope), std::pair("Angles", &LolaState::angles),
    std::pair("Sonar", &LolaState::sonar), std::pair("FSR", &LolaState::fsr),
    std::pair("Touch", &LolaState::touch), std::pair("RobotConfig", &LolaState::robot_config));
inline constexpr auto kLolaCommandFields = std::tuple(
    std::pair("Position", &LolaCommand::position), std::pair("Stiffness", &LolaCommand::stiffness),
    std::pair("REar", &LolaCommand::right_ear), std::pair("LEar", &LolaCommand::left_ear),
    std::pair("Chest", &LolaCommand::chest), std::pair("LEye", &LolaCommand::left_eye),
    std::pair("REye", &LolaCommand::right_eye), std::pair("LFoot", &LolaCommand::left_foot),
    std::pair("RFoot", &LolaCommand::right_foot), std::pair("Skull", &LolaCommand::skull),
    std::pair("Sonar", &LolaCommand::sonar));

constexpr const auto& fields_of(const LolaState& /*state*/) {
  return kLolaStateFields;
}
constexpr const auto& fields_of(const LolaCommand& /*command*/) {
  return kLolaCommandFields;
}

/** Calls `visit(key, values)` for every key of a state or command, in the order of the frame; the
 * values of a command are optional. */
template <class Frame, class Visit>
void for_each_field(Frame& frame, Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field.first, frame.*field.second), ...); },
             fields_of(frame));
}

/** Calls `visit(values of a, values of b)` for every key of two commands. */
template <class Visit>
void for_each_pair(const LolaCommand& a, LolaCommand& b, Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(a.*field.second, b.*field.second), ...); },
             kLolaCommandFields);
}

}  // namespace nao
