#include "daemons/play/match_view.h"

#include <algorithm>

namespace nao::play {
namespace {

/** Validity of teammates' messages, s. Chosen: their images come 5 to 15 times a second. */
constexpr double kSeenTimeout = 2;
/** Validity of the referee's last message about the ball, s: the time that a team has for its
 * kick (HSL: 45 s). */
constexpr double kBallOutTimeout = 45;
/** Advantage of the present striker, m. Chosen: more than the ball's error at 3 m. */
constexpr double kRoleHysteresis = 0.5;

bool is_fresh(const TeamObservation& seen, double time) {
  return time - seen.time < kSeenTimeout;
}

}  // namespace

std::optional<MatchView> view_match(const MatchState& state, const std::string& robot, double time,
                                    const std::map<std::string, TeamObservation>& seen) {
  const MatchPlayer* own = find_player(state, robot);
  if (own == nullptr) return std::nullopt;
  MatchView view;
  view.phase = state.phase;
  view.penalty = own->penalty;
  view.number = own->number;
  view.team_size = 0;
  view.kicks_off = state.kickoff_team == own->team;
  if (state.event.kind == MatchEventKind::kKickOff) view.since_kick_off = time - state.event.time;
  if (state.event.kind == MatchEventKind::kBallOut && time - state.event.time < kBallOutTimeout) {
    view.ball_out = {time - state.event.time, state.event.team == own->team};
  }
  for (const MatchPlayer& player : state.players) {
    if (player.team != own->team) continue;
    ++view.team_size;
    if (&player == own) continue;
    Teammate mate;
    mate.number = player.number;
    mate.is_penalised = player.penalty != Penalty::kNone;
    mate.is_playing = player.is_autonomous && !mate.is_penalised;
    const auto found = seen.find(player.robot);
    if (found != seen.end() && is_fresh(found->second, time)) mate.seen = found->second;
    view.teammates.push_back(mate);
  }
  return view;
}

std::optional<Eigen::Vector2d> find_team_ball(const MatchView& match,
                                              const std::optional<Eigen::Vector2d>& own,
                                              double time) {
  if (own) return own;
  const TeamObservation* newest = nullptr;
  for (const Teammate& mate : match.teammates) {
    if (!mate.seen.ball || !is_fresh(mate.seen, time)) continue;
    if (newest == nullptr || mate.seen.time > newest->time) newest = &mate.seen;
  }
  return newest != nullptr ? newest->ball : std::nullopt;
}

PlayRole choose_role(const MatchView& match, const Eigen::Vector2d& position,
                     const std::optional<Eigen::Vector2d>& ball, PlayRole present) {
  const bool is_highest = std::none_of(
      match.teammates.begin(), match.teammates.end(),
      [&](const Teammate& mate) { return mate.is_playing && mate.number > match.number; });
  const bool is_alone = std::all_of(match.teammates.begin(), match.teammates.end(),
                                    [](const Teammate& mate) { return mate.is_penalised; });
  if (is_highest && !is_alone) return PlayRole::kKeeper;
  // The keeper among the teammates does not leave its goal for the ball.
  int keeper = match.number;
  for (const Teammate& mate : match.teammates) {
    if (mate.is_playing) keeper = std::max(keeper, mate.number);
  }
  const double advantage = present == PlayRole::kStriker ? kRoleHysteresis : 0;
  for (const Teammate& mate : match.teammates) {
    if (!mate.is_playing || mate.number == keeper) continue;
    if (!ball || !mate.seen.position) {
      // Only their numbers distinguish them.
      if (mate.number < match.number) return PlayRole::kSupporter;
      continue;
    }
    const double own_way = (position - *ball).norm() - advantage;
    const double its_way = (*mate.seen.position - *ball).norm();
    if (its_way < own_way || (its_way == own_way && mate.number < match.number)) {
      return PlayRole::kSupporter;
    }
  }
  return PlayRole::kStriker;
}

}  // namespace nao::play
