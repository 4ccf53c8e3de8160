#include "daemons/referee/game_controller_message.h"

#include <algorithm>
#include <bit>
#include <string>
#include <string_view>

#include "common/error.h"

namespace nao::referee {
namespace {

constexpr std::string_view kHeader = "RGme";
constexpr std::string_view kReturnHeader = "RGrt";
constexpr uint8_t kReturnVersion = 4;
/** Offsets, bytes. */
constexpr size_t kVersion = 4;
/** Where versions up to 18 have the competition's type. */
constexpr size_t kStopped = 8;
constexpr size_t kState = 10;
constexpr size_t kSetPlay = 11;
constexpr size_t kFirstHalf = 12;
constexpr size_t kKickingTeam = 13;
constexpr size_t kTimeLeft = 14;
constexpr size_t kTeams = 18;
/** Within a team. */
constexpr size_t kTeamNumber = 0;
constexpr size_t kScore = 4;
constexpr size_t kPlayers = 10;

using SetPlay = GameControllerData::SetPlay;
using State = GameControllerData::State;

constexpr std::array<SetPlay, 6> kStandardPlatformSetPlays = {
    SetPlay::kNone,       SetPlay::kGoalKick, SetPlay::kFreeKick,
    SetPlay::kCornerKick, SetPlay::kKickIn,   SetPlay::kPenaltyKick};
constexpr std::array<SetPlay, 7> kHumanoidSetPlays = {
    SetPlay::kNone,   SetPlay::kFreeKick, SetPlay::kFreeKick,  SetPlay::kPenaltyKick,
    SetPlay::kKickIn, SetPlay::kGoalKick, SetPlay::kCornerKick};

/** In what the versions differ. */
struct Layout {
  int oldest_version;
  int newest_version;
  /** Bytes of a player. */
  size_t player_size;
  bool has_stopped;
  State last_state;
  std::span<const SetPlay> set_plays;
  /** Codes of penalties: pushing; inactive or incapable; leaving the field. */
  uint8_t pushing;
  uint8_t inactive;
  uint8_t leaving;

  size_t team_size() const {
    return kPlayers + player_size * GameControllerData::Team{}.players.size();
  }
  size_t message_size() const { return kTeams + 2 * team_size(); }
};

constexpr std::array<Layout, 3> kLayouts = {
    Layout{15, 18, 2, false, State::kStandby, kStandardPlatformSetPlays, 2, 4, 6},
    Layout{19, 19, 4, true, State::kFinished, kHumanoidSetPlays, 9, 4, 7},
    Layout{20, 20, 3, true, State::kFinished, kHumanoidSetPlays, 10, 5, 8}};

const Layout& layout_of(int version) {
  for (const Layout& layout : kLayouts) {
    if (version >= layout.oldest_version && version <= layout.newest_version) return layout;
  }
  throw Error("the GameController's messages have version " + std::to_string(version) +
              "; known are " + std::to_string(kLayouts.front().oldest_version) + " to " +
              std::to_string(kLayouts.back().newest_version));
}

[[noreturn]] void throw_unknown(const char* name, uint8_t value) {
  throw Error(std::string("the GameController's message has the unknown ") + name + " " +
              std::to_string(value));
}

State state_of(uint8_t value, const Layout& layout) {
  if (value > static_cast<uint8_t>(layout.last_state)) throw_unknown("state", value);
  return static_cast<State>(value);
}

SetPlay set_play_of(uint8_t value, const Layout& layout) {
  if (value >= layout.set_plays.size()) throw_unknown("set play", value);
  return layout.set_plays[value];
}

Penalty penalty_of(uint8_t code, const Layout& layout) {
  if (code == 0) return Penalty::kNone;
  if (code == layout.pushing) return Penalty::kPushing;
  if (code == layout.inactive) return Penalty::kNotGettingUp;
  if (code == layout.leaving) return Penalty::kLeftField;
  return Penalty::kOperator;
}

GameControllerData::Team read_team(std::span<const uint8_t> bytes, const Layout& layout) {
  GameControllerData::Team team;
  team.number = bytes[kTeamNumber];
  team.score = bytes[kScore];
  for (size_t i = 0; i < team.players.size(); ++i) {
    const size_t player = kPlayers + layout.player_size * i;
    team.players[i] = {penalty_of(bytes[player], layout), bytes[player + 1]};
  }
  return team;
}

/** Writes a number as four bytes, little-endian. */
void write_float(double value, uint8_t* bytes) {
  const auto bits = std::bit_cast<uint32_t>(static_cast<float>(value));
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<uint8_t>(bits >> (8 * i));
}

}  // namespace

GameControllerData decode_game_controller(std::span<const uint8_t> message) {
  if (message.size() < kVersion + 1 ||
      !std::equal(kHeader.begin(), kHeader.end(), message.begin())) {
    throw Error("this is not a GameController message");
  }
  GameControllerData data;
  data.version = message[kVersion];
  const Layout& layout = layout_of(data.version);
  if (message.size() != layout.message_size()) {
    throw Error("the GameController's message of version " + std::to_string(data.version) +
                " has " + std::to_string(message.size()) + " bytes instead of " +
                std::to_string(layout.message_size()));
  }
  data.state = state_of(message[kState], layout);
  data.is_stopped = layout.has_stopped && message[kStopped] == 1;
  data.set_play = set_play_of(message[kSetPlay], layout);
  data.is_first_half = message[kFirstHalf] == 1;
  data.kicking_team = message[kKickingTeam];
  data.time_left = static_cast<int16_t>(message[kTimeLeft] | message[kTimeLeft + 1] << 8);
  for (size_t i = 0; i < 2; ++i) {
    const size_t size = layout.team_size();
    data.teams[i] = read_team(message.subspan(kTeams + i * size, size), layout);
  }
  return data;
}

std::array<uint8_t, kGameControllerReturnSize> encode(const GameControllerReturn& data) {
  constexpr double kMillimeters = 1000;
  std::array<uint8_t, kGameControllerReturnSize> bytes{};
  std::copy(kReturnHeader.begin(), kReturnHeader.end(), bytes.begin());
  bytes[4] = kReturnVersion;
  bytes[5] = static_cast<uint8_t>(data.player_number);
  bytes[6] = static_cast<uint8_t>(data.team_number);
  bytes[7] = data.is_fallen ? 1 : 0;
  write_float(kMillimeters * data.pose[0], &bytes[8]);
  write_float(kMillimeters * data.pose[1], &bytes[12]);
  write_float(data.pose[2], &bytes[16]);
  write_float(data.ball_age.value_or(-1), &bytes[20]);
  write_float(kMillimeters * data.ball[0], &bytes[24]);
  write_float(kMillimeters * data.ball[1], &bytes[28]);
  return bytes;
}

}  // namespace nao::referee
