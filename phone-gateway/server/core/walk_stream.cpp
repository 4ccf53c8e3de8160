#include "phone-gateway/server/core/walk_stream.h"

#include <utility>

namespace nao::gateway {
namespace {

/** Transmissions of zero velocity at the end. With 1 % of messages lost, all three are lost once in
 * a million walks. */
constexpr int kNumZeros = 3;

}  // namespace

// All velocities of one walk have one command number, see walk_command_t.
void WalkStream::begin(std::string source, int64_t command_id) {
  source_ = std::move(source);
  command_id_ = command_id;
  is_walking_ = true;
  num_zeros_left_ = 0;
}

Command WalkStream::update(const WalkCommand& velocity, double now) {
  velocity_ = velocity;
  last_update_ = now;
  next_repeat_ = now + limits_.repeat_period;
  return {source_, command_id_, velocity_};
}

void WalkStream::end(double now) {
  if (!is_walking_) return;
  is_walking_ = false;
  num_zeros_left_ = kNumZeros;
  next_repeat_ = now;
}

// Without zeros: what comes next has replaced the walk already.
void WalkStream::abandon() {
  is_walking_ = false;
  num_zeros_left_ = 0;
}

std::optional<Command> WalkStream::step(double now) {
  // The driver is silent: the walk ends as if it had sent zero.
  if (is_walking_ && now - last_update_ >= limits_.walk_timeout) end(now);
  if (now < next_repeat_) return std::nullopt;
  if (is_walking_) {
    next_repeat_ = now + limits_.repeat_period;
    return Command{source_, command_id_, velocity_};
  }
  if (num_zeros_left_ > 0) {
    --num_zeros_left_;
    next_repeat_ = now + limits_.repeat_period;
    return Command{source_, command_id_, WalkCommand{}};
  }
  return std::nullopt;
}

}  // namespace nao::gateway
