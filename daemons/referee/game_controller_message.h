#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "messages/match_state.h"

namespace nao::referee {

/** Ports of the RoboCup GameController: it sends its messages to the first one on the robots'
 * hosts, and receives those of the robots at the second one on its own. */
inline constexpr uint16_t kGameControllerPort = 3838;
inline constexpr uint16_t kGameControllerReturnPort = 3939;

/** Message that the RoboCup GameController sends twice a second.
 *
 * Source of all fields and values: RoboCupGameControlData.h, little-endian,
 * - of RoboCup-SPL/GameController3 (Standard Platform League): versions 15 to 18, 118 bytes;
 * - of RoboCup-HumanoidSoccerLeague/GameController (the leagues merged in 2026): version 19 (its
 *   release 6), 198 bytes, and version 20 (release 7), 158 bytes. They have other set plays and
 *   penalties, no standby, a flag for stopped play instead of the competition's phase, and 4 or 3
 *   bytes for a player instead of 2. */
struct GameControllerData {
  enum class State { kInitial, kReady, kSet, kPlaying, kFinished, kStandby };
  /** Set plays of all versions; direct and indirect free kicks are both taken where the ball is. */
  enum class SetPlay { kNone, kGoalKick, kFreeKick, kCornerKick, kKickIn, kPenaltyKick };
  /** Penalty of a player. */
  struct PlayerPenalty {
    /** Penalties without a kind of their own are the referees' decisions, Penalty::kOperator. */
    Penalty kind = Penalty::kNone;
    /** s. */
    int time_left = 0;
  };
  struct Team {
    int number = 0;
    int score = 0;
    /** By the number on the shirt, from 1 on, less 1. */
    std::array<PlayerPenalty, 20> players{};
  };

  int version = 0;
  State state = State::kInitial;
  /** Play is stopped for a moment, in which robots must not move; versions 19 and 20. */
  bool is_stopped = false;
  SetPlay set_play = SetPlay::kNone;
  bool is_first_half = true;
  /** Number of a team; 255: none. */
  int kicking_team = 255;
  /** Time left in this half, s; negative if the half should have ended. */
  int time_left = 0;
  std::array<Team, 2> teams{};
};

/** @throws Error  naming what is wrong: size, header, version, a value. */
GameControllerData decode_game_controller(std::span<const uint8_t> message);

/** Message of a robot to the GameController. Source as above: all versions of the message have
 * version 4 of the answer. */
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
