#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nao::playback {

/** 64-bit FNV-1a over bytes (G. Fowler, L. C. Noll, K.-P. Vo; draft-eastlake-fnv). */
class GoldenHash {
 public:
  void add(uint64_t bits) {
    for (int shift = 0; shift < 64; shift += 8) add_byte(static_cast<uint8_t>(bits >> shift));
  }
  void add(int64_t number) { add(static_cast<uint64_t>(number)); }
  /** Its bits: 0 and -0 differ. */
  void add(double number) { add(std::bit_cast<uint64_t>(number)); }
  void add(std::string_view text) {
    for (const char letter : text) add_byte(static_cast<uint8_t>(letter));
    add_byte(0);
  }
  template <size_t N>
  void add(const double (&numbers)[N]) {
    for (const double number : numbers) add(number);
  }

  uint64_t value() const { return value_; }

 private:
  void add_byte(uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }

  uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace nao::playback
