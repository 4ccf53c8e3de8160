#include "daemons/referee/game_controller_message.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "common/error.h"

namespace nao::referee {
namespace {

constexpr std::string_view kHeader = "RGme";
constexpr std::string_view kReturnHeader = "RGrt";
/** Versions of the GameController's message that are read, and of the answer to it. */
constexpr int kOldestVersion = 15;
constexpr int kNewestVersion = 18;
constexpr uint8_t kReturnVersion = 4;
/** Offsets, bytes. */
constexpr size_t kVersion = 4;
constexpr size_t kState = 10;
constexpr size_t kSetPlay = 11;
constexpr size_t kFirstHalf = 12;
constexpr size_t kKickingTeam = 13;
constexpr size_t kTimeLeft = 14;
constexpr size_t kTeams = 18;
constexpr size_t kTeamSize = 50;
constexpr size_t kMessageSize = kTeams + 2 * kTeamSize;
/** Within a team. */
constexpr size_t kTeamNumber = 0;
constexpr size_t kScore = 4;
constexpr size_t kPlayers = 10;

template <class Enumeration>
Enumeration read_enumeration(uint8_t value, Enumeration last, const char* name) {
  if (value > static_cast<uint8_t>(last)) {
    throw Error(std::string("the GameController's message has the unknown ") + name + " " +
                std::to_string(value));
  }
  return static_cast<Enumeration>(value);
}

GameControllerData::Team read_team(std::span<const uint8_t> bytes) {
  GameControllerData::Team team;
  team.number = bytes[kTeamNumber];
  team.score = bytes[kScore];
  for (size_t i = 0; i < team.players.size(); ++i) {
    team.players[i] = {bytes[kPlayers + 2 * i], bytes[kPlayers + 2 * i + 1]};
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
  if (data.version < kOldestVersion || data.version > kNewestVersion) {
    throw Error("the GameController's messages have version " + std::to_string(data.version) +
                "; known are " + std::to_string(kOldestVersion) + " to " +
                std::to_string(kNewestVersion));
  }
  if (message.size() != kMessageSize) {
    throw Error("the GameController's message has " + std::to_string(message.size()) +
                " bytes instead of " + std::to_string(kMessageSize));
  }
  data.state = read_enumeration(message[kState], GameControllerData::State::kStandby, "state");
  data.set_play =
      read_enumeration(message[kSetPlay], GameControllerData::SetPlay::kPenaltyKick, "set play");
  data.is_first_half = message[kFirstHalf] == 1;
  data.kicking_team = message[kKickingTeam];
  data.time_left = static_cast<int16_t>(message[kTimeLeft] | message[kTimeLeft + 1] << 8);
  for (size_t i = 0; i < 2; ++i) {
    data.teams[i] = read_team(message.subspan(kTeams + i * kTeamSize, kTeamSize));
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
