#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace nao::referee {

/** A message as the RoboCup GameController sends it, written byte by byte from its header file and
 * independent of the decoder under test. */
struct GameControllerPacket {
  uint8_t version = 18;
  /** From version 19 on. */
  uint8_t stopped = 0;
  uint8_t state = 0;
  uint8_t set_play = 0;
  uint8_t first_half = 1;
  uint8_t kicking_team = 5;
  int16_t seconds = 600;
  std::array<uint8_t, 2> team_numbers{5, 12};
  std::array<uint8_t, 2> scores{0, 0};
  /** Penalty and its seconds of players 1 and 2 of both teams. */
  std::array<std::array<std::array<uint8_t, 2>, 2>, 2> penalties{};

  std::vector<uint8_t> bytes() const {
    std::vector<uint8_t> out;
    for (const char c : std::string_view("RGme")) out.push_back(static_cast<uint8_t>(c));
    // version, packet, players a team, then up to version 18 competition phase and type, later
    // competition type and whether play is stopped; game phase
    for (const int value : {int{version}, 1, 7, 0, version >= 19 ? int{stopped} : 0, 0}) {
      out.push_back(static_cast<uint8_t>(value));
    }
    for (const uint8_t value : {state, set_play, first_half, kicking_team}) out.push_back(value);
    const auto add_word = [&out](int value) {
      out.push_back(static_cast<uint8_t>(value & 0xff));
      out.push_back(static_cast<uint8_t>(value >> 8 & 0xff));
    };
    add_word(seconds);
    add_word(0);
    for (size_t team = 0; team < 2; ++team) {
      // number, colors of players and keeper, keeper, score, penalty shots
      for (const int value : {int{team_numbers[team]}, 0, 1, 1, int{scores[team]}, 0}) {
        out.push_back(static_cast<uint8_t>(value));
      }
      add_word(0);
      add_word(1200);
      for (size_t player = 0; player < 20; ++player) {
        for (size_t k = 0; k < 2; ++k) out.push_back(player < 2 ? penalties[team][player][k] : 0);
        // warnings and cautions; cautions
        out.resize(out.size() + (version == 19 ? 2 : version == 20 ? 1 : 0), 1);
      }
    }
    return out;
  }
};

}  // namespace nao::referee
