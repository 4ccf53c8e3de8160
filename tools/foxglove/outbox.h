#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace nao::foxglove {

/** A WebSocket message to send. Clients share the body. */
struct OutgoingMessage {
  bool is_text = false;
  std::string head;
  /** May be null. */
  std::shared_ptr<const std::string> body;

  size_t size() const { return head.size() + (body ? body->size() : 0); }
};

/** Messages that wait for a client, within limits, so that a client that reads slowly or not at all
 * costs no more than them.
 *
 * Answers wait in order. The newest messages of a channel wait: as many as arrive in a short pause
 * of the client, and one if they are large (images). */
class Outbox {
 public:
  /** Messages of one channel that may wait. Chosen: 0.1 s at 100 a second. */
  static constexpr size_t kMaxWaiting = 10;
  /** Size from which one may wait, bytes. Chosen: above any state, below usual images. */
  static constexpr size_t kLargeBytes = 16384;

  /** @param max_bytes  Of all messages that wait. */
  explicit Outbox(size_t max_bytes) : max_bytes_(max_bytes) {}

  /** Adds an answer. @return false if it does not fit beside the other answers: the client must be
   * disconnected. */
  [[nodiscard]] bool add_answer(OutgoingMessage message);
  /** Adds a message of a channel; drops older ones of this channel, or of any where space is
   * needed. */
  void add(uint32_t channel, OutgoingMessage message);
  /** Drops the messages of a channel. */
  void forget(uint32_t channel);

  /** @return Nothing if none waits. */
  std::optional<OutgoingMessage> next();

  size_t num_bytes() const { return num_bytes_; }
  bool empty() const { return queue_.empty(); }
  /** Messages of channels that were dropped so far. */
  int64_t num_dropped() const { return num_dropped_; }

 private:
  struct Entry {
    OutgoingMessage message;
    /** None: an answer. */
    std::optional<uint32_t> channel;
  };

  /** Drops the oldest message of this channel, or of any if none is given.
   * @return false if there is none. */
  bool drop_oldest(std::optional<uint32_t> channel);

  size_t max_bytes_;
  std::deque<Entry> queue_;
  size_t num_bytes_ = 0;
  /** Waiting messages of each channel. */
  std::map<uint32_t, size_t> num_waiting_;
  int64_t num_dropped_ = 0;
};

}  // namespace nao::foxglove
