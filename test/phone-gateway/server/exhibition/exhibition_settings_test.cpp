#include "phone-gateway/server/exhibition/exhibition_settings.h"

#include <gtest/gtest.h>

#include <map>

#include "common/data_path.h"
#include "common/error.h"

namespace nao::gateway {
namespace {

ExhibitionSettings parse(const std::string& text) {
  return parse_exhibition(text, "fair.yaml", {"Vega"});
}

TEST(ExhibitionSettings, OfTheExampleAreTheDefaultsWhereTheyAreNoList) {
  const ExhibitionSettings example =
      load_exhibition(data_path() / "exhibition" / "example.yaml", data_path());
  const ExhibitionSettings defaults = parse("{}");
  EXPECT_EQ(example.rules.turn, defaults.rules.turn);
  EXPECT_EQ(example.rules.warning, defaults.rules.warning);
  EXPECT_EQ(example.rules.idle, defaults.rules.idle);
  EXPECT_EQ(example.rules.changeover, defaults.rules.changeover);
  EXPECT_EQ(example.rules.reconnect, defaults.rules.reconnect);
  EXPECT_EQ(example.rules.max_waiting, defaults.rules.max_waiting);
  EXPECT_EQ(example.speed, defaults.speed);
  EXPECT_EQ(example.language, defaults.language);
  EXPECT_EQ(example.fence.size(), 4u);
  EXPECT_EQ(example.greetings.size(), 3u);
  EXPECT_GE(example.nicknames.size(), 100u);
}

TEST(ExhibitionSettings, NameFileLineAndKeyOfAFault) {
  const std::map<std::string, std::string> faults{
      {"turn: 0", "fair.yaml:1: turn"},
      {"speed: 2", "is above 1"},
      {"turns: 3", "turns"},
      {"turn: 10\nwarning: 10", "not shorter than the turn"},
      {"may_speak: perhaps", "neither true nor false"},
      {"fence: {frame: moon, corners: [[0,0],[1,0],[1,1]]}", "neither field nor start"},
      {"fence: {frame: start, corners: [[0,0],[1,0]]}", "has 2 points"},
      {"fence: {frame: start, corners: [[0,0],[1,1],[1,0],[0,1]]}", "edges that cross"},
      {"fence: {frame: start, corners: [[0,0],[1,0],[1,1]]}\nmay_play: true", "not possible"},
      {"challenge: {gate: [[0,0]]}", "has 1 points"},
      {"challenge: {gate: [[0,0],[1,0]], goal: [[0,0],[1,0]]}", "both a gate and a goal"}};
  for (const auto& [text, expected] : faults) {
    try {
      parse(text);
      ADD_FAILURE() << text;
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace nao::gateway
