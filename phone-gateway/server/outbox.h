#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "phone-gateway/server/message_bytes.h"

namespace nao {

/** What waits to be sent to one client: answers and notices in order, and at most one state and one
 * image, which are made only when the connection can take them, so that a slow client gets fewer
 * of them but always the newest. */
class Outbox {
 public:
  enum class Next { kNothing, kMessage, kState, kImage };

  void push(MessageBytes message) { messages_.push_back(std::move(message)); }
  void want_state() { num_skipped_ += std::exchange(wants_state_, true) ? 1 : 0; }
  void want_image() { num_skipped_ += std::exchange(wants_image_, true) ? 1 : 0; }

  /** What the connection shall send next. A state goes before an image, which is ten times as
   * long, but only once: a slow client gets both. */
  Next next() const {
    if (!messages_.empty()) return Next::kMessage;
    if (wants_state_ && !is_image_passed_over_) return Next::kState;
    return wants_image_ ? Next::kImage : Next::kNothing;
  }

  /** Takes out what next() told: the message itself, or the mark that one shall be made. */
  MessageBytes take_message() {
    MessageBytes message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }
  void take_state() {
    wants_state_ = false;
    is_image_passed_over_ = wants_image_;
  }
  void take_image() {
    wants_image_ = false;
    is_image_passed_over_ = false;
  }

  size_t num_messages() const { return messages_.size(); }
  /** States and images that a newer one replaced before they could be sent. */
  uint64_t num_skipped() const { return num_skipped_; }

 private:
  std::deque<MessageBytes> messages_;
  bool wants_state_ = false;
  bool wants_image_ = false;
  bool is_image_passed_over_ = false;
  uint64_t num_skipped_ = 0;
};

}  // namespace nao
