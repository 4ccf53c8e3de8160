#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "lola/frame.h"

namespace nao {

/** Writes a state frame: a map of 13 keys in fixed order, every number except the status as
 * float32.
 * @return Bytes written, 896 if ids have 20 and versions 5 characters; 0 if the memory is too
 * small. */
size_t encode(const LolaState& state, std::span<uint8_t> memory);

/** Writes a command: a map of the keys that are set.
 * @return Bytes written, 786 at most; 0 if the memory is too small. */
size_t encode(const LolaCommand& command, std::span<uint8_t> memory);

/** Result of decode(). */
struct LolaDecoding {
  enum class Status { kDone, kIncomplete, kMalformed };

  Status status = Status::kIncomplete;
  /** Bytes of the map, if it is complete. */
  size_t size = 0;
  /** Its fault, if it is malformed. */
  std::string error;
};

/** Reads the state at the beginning of the input. All keys must be there once, in any order;
 * unknown ones are ignored. Numbers may have any MessagePack type. */
[[nodiscard]] LolaDecoding decode(std::span<const uint8_t> bytes, LolaState& state);

/** Reads the command at the beginning of the input: any keys, each at most once, in any order;
 * unknown ones are ignored. `command` has the keys of the map, and no others. */
[[nodiscard]] LolaDecoding decode(std::span<const uint8_t> bytes, LolaCommand& command);

/** Takes bytes from a socket in any pieces and gives the messages that they hold. */
template <class Message>
class LolaStream {
 public:
  /** Longest message that is accepted. Chosen: four times the longest that is sent. */
  static constexpr size_t kMaxBytes = 4 * kLolaStateBytes;

  /** Memory for the next bytes, never empty after next() has returned false. */
  std::span<uint8_t> free_memory() { return std::span(memory_).subspan(size_); }
  /** Reports how many bytes were written to free_memory(). */
  void note_received(size_t num_bytes) { size_ += num_bytes; }

  /** @return Whether there was a whole message, which is then in `message`. After an error() there
   * is none any more. */
  bool next(Message& message) {
    if (!error_.empty()) return false;
    const LolaDecoding decoding = decode(std::span<const uint8_t>(memory_.data(), size_), message);
    if (decoding.status == LolaDecoding::Status::kMalformed) error_ = decoding.error;
    if (decoding.status == LolaDecoding::Status::kIncomplete && size_ == memory_.size()) {
      error_ = "it is longer than " + std::to_string(kMaxBytes) + " bytes";
    }
    if (decoding.status != LolaDecoding::Status::kDone) return false;
    std::copy(memory_.begin() + static_cast<long>(decoding.size),
              memory_.begin() + static_cast<long>(size_), memory_.begin());
    size_ -= decoding.size;
    return true;
  }

  /** Why the stream cannot be read on; empty if it can. */
  const std::string& error() const { return error_; }

 private:
  std::array<uint8_t, kMaxBytes> memory_;
  size_t size_ = 0;
  std::string error_;
};

}  // namespace nao
