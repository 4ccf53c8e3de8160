#include "phone-gateway/server/exhibition/queue_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "common/error.h"
#include "common/json_text.h"

namespace nao::gateway {

using Json = nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Visitor, key, nickname, absence)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ExhibitionCounts, turns, driven, left, idle, skipped, gone,
                                   falls, stops, faults)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(OperatorChoices, forbids_kicks, forbids_falls, speed, volume)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(QueueState, turn_left, turn_time, challenge_time, idle_time,
                                   changeover_left, waiting, served, is_paused, is_resting,
                                   num_nicknames, best_time, best_nickname)

namespace {

constexpr int kVersion = 1;
/** Longest text, greatest number (most of them are s), and most visitors of a list. Chosen: above
 * all that is written. */
constexpr size_t kMaxStateText = 100;
constexpr double kMaxNumber = 1e7;
constexpr size_t kMaxVisitors = 2000;

[[noreturn]] void fail(const std::string& what) {
  throw Error("the state of the exhibition: " + what);
}

/** Checks what no type says. @param keys  Of the visitors so far. */
void check(const Json& object, std::set<std::string>& keys) {
  for (const auto& [name, value] : object.items()) {
    const double most = name == "speed" || name == "volume" ? 1 : kMaxNumber;
    const double number = value.is_number() ? value.get<double>() : 0;
    if (!(number >= 0 && number <= most)) fail(name + " is out of range");
    if (value.is_string() && value.get_ref<const std::string&>().size() > kMaxStateText) {
      fail(name + " is too long");
    }
    if (value.is_array() && value.size() > kMaxVisitors) fail(name + " is too long");
    if (value.is_structured()) check(value, keys);
    if (name == "key" && !keys.insert(value).second) fail("a key is there twice");
  }
}

}  // namespace

std::string write_queue_state(const QueueState& state) {
  Json json = state;
  json["version"] = kVersion;
  if (state.driver) json["driver"] = *state.driver;
  json.update(state.choices);
  json.update(state.counts);
  return json.dump();
}

QueueState read_queue_state(std::string_view text) {
  try {
    const Json json = parse_json(text);
    std::set<std::string> keys;
    check(json, keys);
    if (json.at("version") != kVersion) fail("version is not 1");
    auto state = json.get<QueueState>();
    if (json.contains("driver")) state.driver = json.at("driver").get<Visitor>();
    state.choices = json.get<OperatorChoices>();
    state.counts = json.get<ExhibitionCounts>();
    return state;
  } catch (const Json::exception& error) {
    fail(error.what());
  }
}

std::string write_exhibition_report(const QueueState& state) {
  const ExhibitionCounts& counts = state.counts;
  std::string text = fmt::format(
      "Exhibition\n"
      "Visitors that drove: {}, for {:.0f} minutes in all\n"
      "Turns ended early: {} left, {} did nothing, {} skipped by the operator\n"
      "Left before their turn: {}\n"
      "Falls: {}. Stops: {}. Faults: {}\n",
      counts.turns, counts.driven / 60, counts.left, counts.idle, counts.skipped, counts.gone,
      counts.falls, counts.stops, counts.faults);
  if (state.best_time > 0) {
    text += fmt::format("Best time: {:.1f} s, {}\n", state.best_time, state.best_nickname);
  }
  return text;
}

}  // namespace nao::gateway
