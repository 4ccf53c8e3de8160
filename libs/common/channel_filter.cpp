#include "common/channel_filter.h"

#include <cstdint>

namespace nao {
namespace {

/** Bytes before the magic number of a datagram, and before the channel of a message in one
 * datagram: the kernel's filter begins at the UDP header; magic and sequence number have 4 each. */
constexpr uint32_t kMagicOffset = 8;
constexpr uint32_t kChannelOffset = 16;
/** "LC02": a message in one datagram. */
constexpr uint32_t kWholeMessage = 0x4c433032;
constexpr uint32_t kPass = 0xffffffff;
constexpr uint32_t kDrop = 0;

sock_filter load(uint16_t size, uint32_t offset) {
  return BPF_STMT(static_cast<uint16_t>(BPF_LD | size | BPF_ABS), offset);
}

sock_filter skip_unless_equal(uint32_t value, size_t num_skipped) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, static_cast<uint8_t>(num_skipped));
}

/** Passes the datagram if its channel is this one, else goes on behind the last instruction. A word
 * is read only if all before it were equal, so that no read ends behind the datagram's eight bytes
 * of the message's type. */
std::vector<sock_filter> test_of(const std::string& channel) {
  // With the 0 at its end.
  const size_t size = channel.size() + 1;
  struct Comparison {
    sock_filter load;
    uint32_t value;
  };
  std::vector<Comparison> comparisons;
  for (size_t i = 0; i < size;) {
    const size_t width = size - i >= 4 ? 4 : size - i >= 2 ? 2 : 1;
    uint32_t value = 0;
    for (size_t k = 0; k < width; ++k) {
      value = value << 8 | static_cast<uint8_t>(channel.c_str()[i + k]);
    }
    const uint16_t code = width == 4 ? BPF_W : width == 2 ? BPF_H : BPF_B;
    comparisons.push_back({load(code, kChannelOffset + static_cast<uint32_t>(i)), value});
    i += width;
  }
  std::vector<sock_filter> code;
  for (size_t i = 0; i < comparisons.size(); ++i) {
    code.push_back(comparisons[i].load);
    code.push_back(skip_unless_equal(comparisons[i].value, 2 * (comparisons.size() - 1 - i) + 1));
  }
  code.push_back(BPF_STMT(BPF_RET | BPF_K, kPass));
  return code;
}

}  // namespace

std::vector<sock_filter> make_channel_filter(const std::vector<std::string>& channels) {
  std::vector<sock_filter> program;
  program.push_back(load(BPF_W, kMagicOffset));
  // Anything else passes: LCM looks at it.
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kWholeMessage, 1, 0));
  program.push_back(BPF_STMT(BPF_RET | BPF_K, kPass));
  for (const std::string& channel : channels) {
    const std::vector<sock_filter> test = test_of(channel);
    program.insert(program.end(), test.begin(), test.end());
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, kDrop));
  if (program.size() > BPF_MAXINSNS) program.clear();
  return program;
}

}  // namespace nao
