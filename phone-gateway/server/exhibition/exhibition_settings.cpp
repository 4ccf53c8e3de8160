#include "phone-gateway/server/exhibition/exhibition_settings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/text_file.h"
#include "common/yaml_entry.h"
#include "phone-gateway/server/exhibition/fence.h"

namespace nao::gateway {
namespace {

/** Bounds of lists. Chosen: far above what an exhibition needs. */
constexpr size_t kMaxCorners = 64;
constexpr size_t kMaxWaiting = 1000;
/** Bound of times, s, and of lengths, m. */
constexpr double kMaxSetTime = 3600;
constexpr double kMaxLength = 100;

double read_time(const YamlEntry& root, const char* key, double value) {
  if (!root.has(key)) return value;
  const YamlEntry entry = root.at(key);
  const double time = entry.positive();
  if (time > kMaxSetTime) entry.fail("is above 3600 s");
  return time;
}

std::vector<std::string> read_names(const YamlEntry& entry) {
  std::vector<std::string> names;
  for (const YamlEntry& item : entry.items()) names.push_back(item.text());
  return names;
}

std::vector<Eigen::Vector2d> read_points(const YamlEntry& entry, size_t least, size_t most) {
  std::vector<Eigen::Vector2d> points;
  for (const YamlEntry& item : entry.items()) {
    const std::vector<double> numbers = item.numbers(2);
    if (std::max(std::abs(numbers[0]), std::abs(numbers[1])) > kMaxLength) {
      item.fail("is farther than 100 m");
    }
    points.push_back({numbers[0], numbers[1]});
  }
  if (points.size() < least || points.size() > most) {
    entry.fail("has " + std::to_string(points.size()) + " points; " + std::to_string(least) +
               " to " + std::to_string(most) + " are needed");
  }
  return points;
}

void read_fence(const YamlEntry& entry, ExhibitionSettings& settings) {
  entry.allow_only({"frame", "corners"});
  const std::string frame = entry.at("frame").text();
  if (frame != "field" && frame != "start") entry.at("frame").fail("is neither field nor start");
  settings.is_fence_on_field = frame == "field";
  const YamlEntry corners = entry.at("corners");
  settings.fence = read_points(corners, 3, kMaxCorners);
  const auto& points = settings.fence;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = i + 1; j < points.size(); ++j) {
      if (do_cross(points[i], points[(i + 1) % points.size()], points[j],
                   points[(j + 1) % points.size()])) {
        corners.fail("has edges that cross");
      }
    }
  }
}

void read_challenge(const YamlEntry& entry, ChallengeSettings& challenge) {
  entry.allow_only({"gate", "goal"});
  challenge.is_goal = entry.has("goal");
  if (challenge.is_goal && entry.has("gate")) entry.fail("has both a gate and a goal");
  challenge.posts = read_points(entry.at(challenge.is_goal ? "goal" : "gate"), 2, 2);
}

void read_attract(const YamlEntry& entry, ExhibitionSettings& settings) {
  entry.allow_only({"period", "actions", "motions", "look_at_ball", "greetings"});
  settings.attract_period = read_time(entry, "period", 25);
  if (entry.has("actions")) settings.attract_actions = read_names(entry.at("actions"));
  if (entry.has("motions")) settings.attracts_with_motions = entry.at("motions").flag();
  if (entry.has("look_at_ball")) settings.looks_at_ball = entry.at("look_at_ball").flag();
  if (!entry.has("greetings")) return;
  for (const auto& [language, text] : entry.at("greetings").entries()) {
    settings.greetings.emplace_back(language, text.text());
  }
}

void read_turns(const YamlEntry& root, TurnRules& rules) {
  rules.turn = read_time(root, "turn", rules.turn);
  rules.warning = read_time(root, "warning", rules.warning);
  rules.idle = read_time(root, "idle", rules.idle);
  rules.changeover = read_time(root, "changeover", rules.changeover);
  rules.reconnect = read_time(root, "reconnect", rules.reconnect);
  if (rules.warning >= rules.turn) {
    root.fail("has a warning that is not shorter than the turn");
  }
  if (!root.has("max_waiting")) return;
  const double most = root.at("max_waiting").positive();
  if (most < 1 || most > kMaxWaiting) root.at("max_waiting").fail("is not from 1 to 1000");
  rules.max_waiting = static_cast<size_t>(most);
}

}  // namespace

ExhibitionSettings parse_exhibition(const std::string& text, const std::string& name,
                                    std::vector<std::string> nicknames) {
  const YamlEntry root = YamlEntry::parse<ConfigError>(text, name);
  root.allow_only({"turn", "warning", "idle", "changeover", "reconnect", "max_waiting", "speed",
                   "forbidden", "may_speak", "may_play", "fence", "challenge", "attract",
                   "language"});
  ExhibitionSettings settings;
  settings.nicknames = std::move(nicknames);
  read_turns(root, settings.rules);
  if (root.has("speed")) {
    settings.speed = root.at("speed").positive();
    if (settings.speed > 1) root.at("speed").fail("is above 1");
  }
  if (root.has("forbidden")) settings.forbidden = read_names(root.at("forbidden"));
  if (root.has("may_speak")) settings.may_speak = root.at("may_speak").flag();
  if (root.has("may_play")) settings.may_play = root.at("may_play").flag();
  if (root.has("fence")) read_fence(root.at("fence"), settings);
  if (settings.may_play && !settings.fence.empty()) {
    root.at("may_play").fail("is not possible with a fence: behaviors walk where the ball is");
  }
  if (root.has("challenge")) {
    read_challenge(root.at("challenge"), settings.challenge);
  }
  if (root.has("attract")) read_attract(root.at("attract"), settings);
  if (root.has("language")) {
    settings.language = root.at("language").text();
    if (settings.language.size() != 2) root.at("language").fail("is not a tag of two letters");
  }
  return settings;
}

ExhibitionSettings load_exhibition(const std::filesystem::path& file,
                                   const std::filesystem::path& data) {
  const YamlEntry names =
      YamlEntry::load<ConfigError>(data / "exhibition" / "nicknames.yaml").at("names");
  return parse_exhibition(read_file(file), file.string(), read_names(names));
}

}  // namespace nao::gateway
