#include "phone-gateway/server/exhibition/queue_file.h"

#include <fmt/format.h>

#include <set>

#include "common/error.h"
#include "common/json_text.h"
#include "common/json_writer.h"

namespace nao::gateway {
namespace {

constexpr int kVersion = 1;
/** Longest text and time, and most visitors of a list. Chosen: above all that is written. */
constexpr size_t kMaxStateText = 100;
constexpr double kMaxStateTime = 1e7;
constexpr size_t kMaxVisitors = 2000;

using Count = int ExhibitionCounts::*;
struct CountField {
  const char* name;
  Count value;
};

constexpr CountField kCountFields[] = {
    {"turns", &ExhibitionCounts::turns}, {"left", &ExhibitionCounts::left},
    {"idle", &ExhibitionCounts::idle},   {"skipped", &ExhibitionCounts::skipped},
    {"gone", &ExhibitionCounts::gone},   {"falls", &ExhibitionCounts::falls},
    {"stops", &ExhibitionCounts::stops}, {"faults", &ExhibitionCounts::faults}};

void write(const std::string& key, const Visitor& visitor, JsonWriter& json) {
  json.begin_object(key);
  json.add("key", visitor.key);
  json.add("nickname", visitor.nickname);
  json.add("absence", visitor.absence);
  json.end();
}

void write(const std::string& key, const std::deque<Visitor>& visitors, JsonWriter& json) {
  json.begin_array(key);
  for (const Visitor& visitor : visitors) write("", visitor, json);
  json.end();
}

[[noreturn]] void fail(const std::string& key, const char* what) {
  throw Error("the state of the exhibition: \"" + key + "\" " + what);
}

const nlohmann::json& at(const nlohmann::json& json, const std::string& key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  if (!json.is_object() || found == json.end()) fail(key, "is missing");
  return *found;
}

double read_number(const nlohmann::json& json, const std::string& key, double most) {
  const nlohmann::json& value = at(json, key);
  if (!value.is_number()) fail(key, "is not a number");
  const double number = value.get<double>();
  if (!(number >= 0 && number <= most)) fail(key, "is out of range");
  return number;
}

std::string read_text(const nlohmann::json& json, const std::string& key) {
  const nlohmann::json& value = at(json, key);
  if (!value.is_string()) fail(key, "is not text");
  std::string text = value.get<std::string>();
  if (text.size() > kMaxStateText) fail(key, "is too long");
  return text;
}

bool read_flag(const nlohmann::json& json, const std::string& key) {
  const nlohmann::json& value = at(json, key);
  if (!value.is_boolean()) fail(key, "is neither true nor false");
  return value.get<bool>();
}

Visitor read_visitor(const nlohmann::json& json, std::set<std::string>& keys) {
  Visitor visitor{read_text(json, "key"), read_text(json, "nickname"), false,
                  read_number(json, "absence", kMaxStateTime)};
  if (!keys.insert(visitor.key).second) fail("key", "is there twice");
  return visitor;
}

std::deque<Visitor> read_visitors(const nlohmann::json& json, const std::string& key,
                                  std::set<std::string>& keys) {
  const nlohmann::json& list = at(json, key);
  if (!list.is_array()) fail(key, "is not a list");
  if (list.size() > kMaxVisitors) fail(key, "is too long");
  std::deque<Visitor> visitors;
  for (const nlohmann::json& item : list) visitors.push_back(read_visitor(item, keys));
  return visitors;
}

}  // namespace

std::string write_queue_state(const QueueState& state) {
  JsonWriter json;
  json.begin_object();
  json.add("version", kVersion);
  if (state.driver) write("driver", *state.driver, json);
  json.add("turn_left", state.turn_left);
  json.add("turn_time", state.turn_time);
  json.add("challenge_time", state.challenge_time);
  json.add("idle_time", state.idle_time);
  json.add("changeover_left", state.changeover_left);
  write("waiting", state.waiting, json);
  write("served", state.served, json);
  json.add("is_paused", state.is_paused);
  json.add("is_resting", state.is_resting);
  json.add("num_nicknames", static_cast<int64_t>(state.num_nicknames));
  json.add("best_time", state.best_time);
  json.add("best_nickname", state.best_nickname);
  json.add("forbids_kicks", state.choices.forbids_kicks);
  json.add("forbids_falls", state.choices.forbids_falls);
  json.add("speed", state.choices.speed);
  json.add("volume", state.choices.volume);
  json.add("driven", state.counts.driven);
  for (const CountField& field : kCountFields) json.add(field.name, state.counts.*field.value);
  return json.take();
}

QueueState read_queue_state(std::string_view text) {
  const auto json = try_parse_json(text);
  if (!json) throw Error("the state of the exhibition is not JSON");
  if (read_number(*json, "version", kMaxStateTime) != kVersion) fail("version", "is not 1");
  QueueState state;
  std::set<std::string> keys;
  if (json->contains("driver")) state.driver = read_visitor(at(*json, "driver"), keys);
  state.turn_left = read_number(*json, "turn_left", kMaxStateTime);
  state.turn_time = read_number(*json, "turn_time", kMaxStateTime);
  state.challenge_time = read_number(*json, "challenge_time", kMaxStateTime);
  state.idle_time = read_number(*json, "idle_time", kMaxStateTime);
  state.changeover_left = read_number(*json, "changeover_left", kMaxStateTime);
  state.waiting = read_visitors(*json, "waiting", keys);
  state.served = read_visitors(*json, "served", keys);
  state.is_paused = read_flag(*json, "is_paused");
  state.is_resting = read_flag(*json, "is_resting");
  state.num_nicknames = static_cast<size_t>(read_number(*json, "num_nicknames", 1e9));
  state.best_time = read_number(*json, "best_time", kMaxStateTime);
  state.best_nickname = read_text(*json, "best_nickname");
  state.choices.forbids_kicks = read_flag(*json, "forbids_kicks");
  state.choices.forbids_falls = read_flag(*json, "forbids_falls");
  state.choices.speed = read_number(*json, "speed", 1);
  state.choices.volume = read_number(*json, "volume", 1);
  state.counts.driven = read_number(*json, "driven", kMaxStateTime);
  for (const CountField& field : kCountFields) {
    state.counts.*field.value = static_cast<int>(read_number(*json, field.name, 1e9));
  }
  return state;
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
