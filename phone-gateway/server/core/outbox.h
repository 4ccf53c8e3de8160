#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "phone-gateway/server/core/message_bytes.h"

namespace nao::gateway {

/** Messages to be sent to one client: responses and notices in order, at most one each of state,
 * image, play state and vision, and pieces of audio in order. All but the audio are only marked as
 * due here; they are encoded when the connection can take them, so that a slow client receives
 * fewer of them, but always the newest. A slow client loses the oldest pieces of audio. */
class Outbox {
 public:
  enum class Next { kNothing, kMessage, kPlayState, kVision, kState, kAudio, kImage };
  /** What one connection sends: a client with two receives images and audio over the second one,
   * and states as request_state() says. */
  enum class Part { kAll, kShort, kLong };

  /** Pieces of audio that wait; of more, the oldest are dropped. Chosen: 4 s of speech. */
  static constexpr size_t kMaxAudio = 16;

  void push(MessageBytes message) { messages_.push_back(std::move(message)); }
  /** Inserts a message before those that were pushed after num_messages() was `position`. */
  void insert(size_t position, MessageBytes message) {
    messages_.insert(messages_.begin() + static_cast<std::ptrdiff_t>(position), std::move(message));
  }
  /** @param alternates  Of a client with two connections, each takes every other state. */
  void request_state(bool alternates = false) {
    num_skipped_ += std::exchange(is_state_due_, true) ? 1 : 0;
    is_state_for_second_ = alternates && !is_state_for_second_;
  }
  void request_image() { num_skipped_ += std::exchange(is_image_due_, true) ? 1 : 0; }

  void request_play_state() { num_skipped_ += std::exchange(is_play_state_due_, true) ? 1 : 0; }
  void request_vision() { num_skipped_ += std::exchange(is_vision_due_, true) ? 1 : 0; }

  void push_audio(MessageBytes piece) {
    audio_.push_back(std::move(piece));
    if (audio_.size() <= kMaxAudio) return;
    audio_.pop_front();
    ++num_skipped_;
  }
  /** The speech has ended: what waits of it is not to be played. */
  void clear_audio() { audio_.clear(); }

  /** What the connection must send next. A state goes before audio and images, which are about ten
   * times as long, but only one state, and one piece of audio before an image: a slow client
   * receives all streams.
   * @param takes_image  Whether the connection can take an image now. */
  Next next(bool takes_image, Part part = Part::kAll) const {
    const bool has_image = part != Part::kShort && is_image_due_ && takes_image;
    const bool has_audio = part != Part::kShort && !audio_.empty();
    if (part != Part::kLong) {
      if (!messages_.empty()) return Next::kMessage;
      // Short, and at most 5 and 30 a second: they cannot keep a state waiting.
      if (is_play_state_due_) return Next::kPlayState;
      if (is_vision_due_) return Next::kVision;
    }
    const bool takes_state = part == Part::kAll || is_state_for_second_ == (part == Part::kLong);
    const bool has_other = has_image || has_audio;
    if (is_state_due_ && takes_state && !(has_other_waited_ && has_other)) return Next::kState;
    if (has_audio && !(was_audio_last_ && has_image)) return Next::kAudio;
    return has_image ? Next::kImage : Next::kNothing;
  }

  /** Removes what next() returned: the message or piece itself, or the mark that a state or image
   * is due. */
  MessageBytes take_message() {
    MessageBytes message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }
  void take_play_state() { is_play_state_due_ = false; }
  void take_vision() { is_vision_due_ = false; }
  void take_state() {
    is_state_due_ = false;
    was_audio_last_ = false;
    has_other_waited_ = is_image_due_ || !audio_.empty();
  }
  MessageBytes take_audio() {
    MessageBytes piece = std::move(audio_.front());
    audio_.pop_front();
    was_audio_last_ = true;
    has_other_waited_ = is_image_due_;
    return piece;
  }
  void take_image() {
    is_image_due_ = false;
    was_audio_last_ = false;
    has_other_waited_ = false;
  }

  size_t num_messages() const { return messages_.size(); }
  /** States and images that a newer one replaced before they could be sent, and pieces of audio
   * that were dropped. */
  uint64_t num_skipped() const { return num_skipped_; }

 private:
  std::deque<MessageBytes> messages_;
  std::deque<MessageBytes> audio_;
  bool is_state_due_ = false;
  bool is_state_for_second_ = false;
  bool is_image_due_ = false;
  bool is_play_state_due_ = false;
  bool is_vision_due_ = false;
  /** A state was sent while audio or an image waited: that is next. */
  bool has_other_waited_ = false;
  bool was_audio_last_ = false;
  uint64_t num_skipped_ = 0;
};

}  // namespace nao::gateway
