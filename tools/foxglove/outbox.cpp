#include "tools/foxglove/outbox.h"

#include <algorithm>
#include <utility>

namespace nao::foxglove {

bool Outbox::add_answer(OutgoingMessage message) {
  const size_t size = message.size();
  while (num_bytes_ + size > max_bytes_) {
    if (!drop_oldest(std::nullopt)) return false;
  }
  num_bytes_ += size;
  queue_.push_back({std::move(message), std::nullopt});
  return true;
}

void Outbox::add(uint32_t channel, OutgoingMessage message) {
  const size_t size = message.size();
  const size_t max_waiting = size < kLargeBytes ? kMaxWaiting : 1;
  while (num_waiting_[channel] >= max_waiting) drop_oldest(channel);
  while (num_bytes_ + size > max_bytes_) {
    if (drop_oldest(std::nullopt)) continue;
    ++num_dropped_;
    return;
  }
  num_bytes_ += size;
  ++num_waiting_[channel];
  queue_.push_back({std::move(message), channel});
}

void Outbox::forget(uint32_t channel) {
  while (drop_oldest(channel)) {
  }
  num_waiting_.erase(channel);
}

std::optional<OutgoingMessage> Outbox::next() {
  if (queue_.empty()) return std::nullopt;
  OutgoingMessage message = std::move(queue_.front().message);
  num_bytes_ -= message.size();
  if (queue_.front().channel) --num_waiting_[*queue_.front().channel];
  queue_.pop_front();
  return message;
}

bool Outbox::drop_oldest(std::optional<uint32_t> channel) {
  const auto found = std::find_if(queue_.begin(), queue_.end(), [&](const Entry& entry) {
    return entry.channel && (!channel || entry.channel == channel);
  });
  if (found == queue_.end()) return false;
  num_bytes_ -= found->message.size();
  --num_waiting_[*found->channel];
  ++num_dropped_;
  queue_.erase(found);
  return true;
}

}  // namespace nao::foxglove
