#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace nao::referee {

/** Ports of the RoboCup GameController: it sends its messages to the first one on the robots'
 * hosts, and receives those of the robots at the second one on its own. */
inline constexpr uint16_t kGameControllerPort = 3838;
inline constexpr uint16_t kGameControllerReturnPort = 3939;

/** Message that the RoboCup GameController of the Standard Platform League sends twice a second.
 *
 * Source of all fields and values: RoboCupGameControlData.h of RoboCup-SPL/GameController3,
 * versions 15 to 18 of the message, which have one layout: 118 bytes, little-endian. */
struct GameControllerData {
  enum class State { kInitial, kReady, kSet, kPlaying, kFinished, kStandby };
  enum class SetPlay { kNone, kGoalKick, kPushingFreeKick, kCornerKick, kKickIn, kPenaltyKick };
  /** Penalty of a player. */
  struct Penalty {
    /** 0: none. */
    uint8_t code = 0;
    /** s. */
    int time_left = 0;
  };
  struct Team {
    int number = 0;
    int score = 0;
    /** By the number on the shirt, from 1 on, less 1. */
    std::array<Penalty, 20> players{};
  };

  int version = 0;
  State state = State::kInitial;
  SetPlay set_play = SetPlay::kNone;
  bool is_first_half = true;
  /** Number of a team; 255: none. */
  int kicking_team = 255;
  /** Time left in this half, s; negative if the half should have ended. */
  int time_left = 0;
  std::array<Team, 2> teams{};
};

/** Codes of penalties that are named here; all others are the referees' decisions. */
inline constexpr uint8_t kPenaltyPlayerPushing = 2;
inline constexpr uint8_t kPenaltyInactivePlayer = 4;
inline constexpr uint8_t kPenaltyLeavingTheField = 6;

/** @throws Error  naming what is wrong: size, header, version, a value. */
GameControllerData decode_game_controller(std::span<const uint8_t> message);

/** Message of a robot to the GameController. Source as above, version 4 of the return message. */
struct GameControllerReturn {
  int player_number = 1;
  int team_number = 0;
  bool is_fallen = false;
  /** m, m, rad; in the team's frame: x towards the opponents' goal. */
  std::array<double, 3> pose{};
  /** Time since the robot saw the ball, s; nothing: never. */
  std::optional<double> ball_age{};
  /** m, ahead of the robot and to its left. */
  std::array<double, 2> ball{};
};

/** Bytes. */
inline constexpr size_t kGameControllerReturnSize = 32;

std::array<uint8_t, kGameControllerReturnSize> encode(const GameControllerReturn& data);

}  // namespace nao::referee
