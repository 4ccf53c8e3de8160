#include "phone-gateway/server/exhibition/visitor_queue.h"

#include <algorithm>
#include <utility>

namespace nao::gateway {
namespace {

/** A phone that is gone for less, s, is waited for. Chosen: a page that is loaded again, or a
 * restart of the gateway, after which phones come back within 5 s (the app's longest pause). */
constexpr double kShortAbsence = 10;
/** Visitors remembered after their turn. Chosen: more than drive in eight hours at 90 s each. */
constexpr size_t kMaxServed = 1000;
/** Longest turn that the operator can make, s. Chosen. */
constexpr double kMaxTurn = 600;

bool is_expected(const Visitor& visitor) {
  return visitor.is_here || visitor.absence < kShortAbsence;
}

template <class Visitors>
auto find_visitor(Visitors& visitors, const std::string& key) {
  return std::find_if(visitors.begin(), visitors.end(),
                      [&](const Visitor& visitor) { return visitor.key == key; });
}

}  // namespace

VisitorQueue::VisitorQueue(TurnRules rules, std::vector<std::string> nicknames, QueueState state)
    : rules_(rules), nicknames_(std::move(nicknames)), state_(std::move(state)) {
  // After a restart no phone is connected yet.
  if (state_.driver) state_.driver->is_here = false;
  for (Visitor& visitor : state_.waiting) visitor.is_here = false;
}

std::deque<Visitor>::iterator VisitorQueue::find_waiting(const std::string& key) {
  return find_visitor(state_.waiting, key);
}

std::string VisitorQueue::next_nickname() {
  const size_t number = state_.num_nicknames++;
  if (nicknames_.empty()) return std::to_string(number + 1);
  const std::string& name = nicknames_[number % nicknames_.size()];
  const size_t round = number / nicknames_.size();
  return round == 0 ? name : name + " " + std::to_string(round + 1);
}

bool VisitorQueue::attend(const std::string& key, bool again) {
  if (state_.driver && state_.driver->key == key) {
    state_.driver->is_here = true;
    return true;
  }
  if (const auto known = find_waiting(key); known != state_.waiting.end()) {
    known->is_here = true;
    known->absence = 0;
    return true;
  }
  const auto served = find_visitor(state_.served, key);
  if (served != state_.served.end() && !again) return true;
  if (state_.waiting.size() >= rules_.max_waiting) return false;
  Visitor visitor{key, "", true, 0};
  if (served != state_.served.end()) {
    visitor.nickname = served->nickname;
    state_.served.erase(served);
  } else {
    visitor.nickname = next_nickname();
  }
  state_.waiting.push_back(std::move(visitor));
  return true;
}

void VisitorQueue::leave(const std::string& key) {
  if (state_.driver && state_.driver->key == key) return end_turn(End::kLeft);
  if (const auto known = find_waiting(key); known != state_.waiting.end()) {
    state_.waiting.erase(known);
    ++state_.counts.gone;
  }
}

void VisitorQueue::lose(const std::string& key) {
  if (state_.driver && state_.driver->key == key) state_.driver->is_here = false;
  if (const auto known = find_waiting(key); known != state_.waiting.end()) known->is_here = false;
}

void VisitorQueue::step(double dt) {
  for (Visitor& visitor : state_.waiting) {
    if (!visitor.is_here) visitor.absence += dt;
  }
  state_.counts.gone += static_cast<int>(std::erase_if(
      state_.waiting, [&](const Visitor& visitor) { return visitor.absence > rules_.reconnect; }));
  if (is_halted()) return;
  if (state_.driver) {
    state_.turn_left -= dt;
    state_.turn_time += dt;
    state_.idle_time += dt;
    state_.counts.driven += dt;
    if (state_.turn_left <= 0) return end_turn(End::kTime);
    if (state_.idle_time >= rules_.idle) return end_turn(End::kIdle);
    return;
  }
  state_.changeover_left = std::max(0.0, state_.changeover_left - dt);
  if (state_.changeover_left > 0) return;
  // One whose phone is gone keeps its place, and others drive meanwhile.
  const auto next = std::find_if(state_.waiting.begin(), state_.waiting.end(), is_expected);
  if (next != state_.waiting.end() && next->is_here) begin_turn(next);
}

void VisitorQueue::begin_turn(std::deque<Visitor>::iterator next) {
  state_.driver = std::move(*next);
  state_.waiting.erase(next);
  state_.turn_left = rules_.turn;
  state_.turn_time = 0;
  state_.challenge_time = 0;
  state_.idle_time = 0;
  ++state_.counts.turns;
}

void VisitorQueue::end_turn(End end) {
  Visitor visitor = std::move(*state_.driver);
  state_.driver.reset();
  if (end == End::kRest && state_.turn_left > rules_.turn / 2) {
    --state_.counts.turns;
    state_.waiting.push_front(std::move(visitor));
  } else {
    state_.served.push_back(std::move(visitor));
    if (state_.served.size() > kMaxServed) state_.served.pop_front();
  }
  state_.counts.left += end == End::kLeft ? 1 : 0;
  state_.counts.idle += end == End::kIdle ? 1 : 0;
  state_.counts.skipped += end == End::kSkipped ? 1 : 0;
  state_.turn_left = 0;
  state_.changeover_left = rules_.changeover;
}

void VisitorQueue::set_resting(bool is_resting) {
  if (is_resting && !state_.is_resting && state_.driver) end_turn(End::kRest);
  state_.is_resting = is_resting;
}

void VisitorQueue::skip() {
  if (state_.driver) end_turn(End::kSkipped);
}

void VisitorQueue::extend(double time) {
  if (state_.driver) state_.turn_left = std::min(kMaxTurn, state_.turn_left + time);
}

bool VisitorQueue::has_visitors() const {
  return state_.driver || std::any_of(state_.waiting.begin(), state_.waiting.end(), is_expected);
}

VisitorView VisitorQueue::view(const std::string& key) const {
  using Phase = VisitorView::Phase;
  if (state_.driver && state_.driver->key == key) {
    return {Phase::kDriving, state_.driver->nickname};
  }
  VisitorView view{Phase::kWaiting, "", 0, state_.changeover_left};
  if (state_.driver) view.wait = state_.turn_left + rules_.changeover;
  for (const Visitor& visitor : state_.waiting) {
    if (visitor.key == key) {
      view.nickname = visitor.nickname;
      ++view.place;
      return view;
    }
    if (!is_expected(visitor)) continue;
    ++view.place;
    view.wait += rules_.turn + rules_.changeover;
  }
  const auto served = find_visitor(state_.served, key);
  if (served == state_.served.end()) return {};
  return {Phase::kServed, served->nickname};
}

void VisitorQueue::note_challenge() {
  if (driver() == nullptr || state_.challenge_time > 0) return;
  state_.challenge_time = state_.turn_time;
  if (state_.best_time > 0 && state_.turn_time >= state_.best_time) return;
  state_.best_time = state_.turn_time;
  state_.best_nickname = state_.driver->nickname;
}

}  // namespace nao::gateway
