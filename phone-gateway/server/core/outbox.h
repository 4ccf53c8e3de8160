#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "phone-gateway/server/core/message_bytes.h"

namespace nao::gateway {

/** Messages to be sent to one client: responses and notices in order, and at most one state and one
 * image. State and image are only marked as due here; they are encoded when the connection can take
 * them, so that a slow client receives fewer of them, but always the newest. */
class Outbox {
 public:
  enum class Next { kNothing, kMessage, kState, kImage };

  void push(MessageBytes message) { messages_.push_back(std::move(message)); }
  /** Inserts a message before those that were pushed after num_messages() was `position`. */
  void insert(size_t position, MessageBytes message) {
    messages_.insert(messages_.begin() + static_cast<std::ptrdiff_t>(position), std::move(message));
  }
  void request_state() { num_skipped_ += std::exchange(is_state_due_, true) ? 1 : 0; }
  void request_image() { num_skipped_ += std::exchange(is_image_due_, true) ? 1 : 0; }

  /** What the connection must send next. A state goes before an image, which is about ten times as
   * long, but only one state: a slow client receives both streams. */
  Next next() const {
    if (!messages_.empty()) return Next::kMessage;
    if (is_state_due_ && !has_image_waited_) return Next::kState;
    return is_image_due_ ? Next::kImage : Next::kNothing;
  }

  /** Removes what next() returned: the message itself, or the mark that a state or image is due. */
  MessageBytes take_message() {
    MessageBytes message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }
  void take_state() {
    is_state_due_ = false;
    has_image_waited_ = is_image_due_;
  }
  void take_image() {
    is_image_due_ = false;
    has_image_waited_ = false;
  }

  size_t num_messages() const { return messages_.size(); }
  /** States and images that a newer one replaced before they could be sent. */
  uint64_t num_skipped() const { return num_skipped_; }

 private:
  std::deque<MessageBytes> messages_;
  bool is_state_due_ = false;
  bool is_image_due_ = false;
  /** A state was sent while an image was due: the image is next. */
  bool has_image_waited_ = false;
  uint64_t num_skipped_ = 0;
};

}  // namespace nao::gateway
