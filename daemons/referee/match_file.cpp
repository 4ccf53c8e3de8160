#include "daemons/referee/match_file.h"

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/json_text.h"

namespace nao::referee {
namespace {

using Json = nlohmann::json;

}  // namespace

std::string to_json(const MatchState& state) {
  Json players = Json::array();
  for (const MatchPlayer& player : state.players) {
    players.push_back({{"robot", player.robot},
                       {"team", player.team},
                       {"number", player.number},
                       {"penalty", static_cast<int>(player.penalty)},
                       {"penalty_left_s", player.penalty_left}});
  }
  const Json json = {{"match_id", state.id},
                     {"phase", static_cast<int>(state.phase)},
                     {"half", state.half},
                     {"time_left_s", state.time_left},
                     {"kickoff_team", state.kickoff_team},
                     {"score", state.score},
                     {"event_id", state.event.id},
                     {"players", players}};
  return json.dump(2) + "\n";
}

MatchState match_from_json(const std::string& text) {
  naolcm::match_state_t message{};
  try {
    const Json json = parse_json(text);
    message.match_id = json.at("match_id").get<int64_t>();
    message.phase = json.at("phase").get<int8_t>();
    message.half = json.at("half").get<int8_t>();
    message.time_left = json.at("time_left_s").get<double>();
    message.kickoff_team = json.at("kickoff_team").get<int8_t>();
    for (size_t team = 0; team < 2; ++team) {
      message.score[team] = json.at("score").at(team).get<int32_t>();
    }
    message.event_id = json.at("event_id").get<int64_t>();
    message.event_team = -1;
    for (const Json& entry : json.at("players")) {
      naolcm::player_t player{};
      player.robot = entry.at("robot").get<std::string>();
      player.team = entry.at("team").get<int8_t>();
      player.number = entry.at("number").get<int8_t>();
      player.penalty = entry.at("penalty").get<int8_t>();
      player.penalty_left = entry.at("penalty_left_s").get<double>();
      message.players.push_back(player);
    }
  } catch (const Json::exception& error) {
    throw Error(std::string("no match: ") + error.what());
  }
  message.num_players = static_cast<int32_t>(message.players.size());
  // The message's own checks.
  return to_match_state(message);
}

std::string event_to_json(const MatchEvent& event, const MatchState& state) {
  nlohmann::ordered_json json = {{"match_id", state.id},
                                 {"event_id", event.id},
                                 {"time_s", event.time},
                                 {"half", state.half},
                                 {"time_left_s", state.time_left},
                                 {"event", std::string(to_string(event.kind))},
                                 {"score", state.score}};
  if (event.team >= 0) json["team"] = event.team;
  if (!event.robot.empty()) json["robot"] = event.robot;
  return json.dump();
}

}  // namespace nao::referee
