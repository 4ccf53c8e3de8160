#include "common/channel_filter.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>

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

/** Whether a descriptor is a UDP socket whose port others may use, too: LCM's receiving socket, in
 * contrast to its sending one, of which the kernel has chosen the port. */
bool is_receiving_socket(int descriptor) {
  int value = 0;
  socklen_t size = sizeof value;
  if (getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &value, &size) != 0 || value != SOCK_DGRAM) {
    return false;
  }
  size = sizeof value;
  if (getsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &value, &size) != 0 || value == 0) {
    return false;
  }
  sockaddr_in address{};
  size = sizeof address;
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return false;
  return address.sin_family == AF_INET && address.sin_port != 0;
}

std::set<int> receiving_sockets() {
  std::set<int> result;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const int descriptor = std::stoi(entry.path().filename());
    if (is_receiving_socket(descriptor)) result.insert(descriptor);
  }
  return result;
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

void ChannelFilter::open_socket(const std::function<void()>& open) {
  if (is_open_) return;
  is_open_ = true;
  const std::set<int> before = receiving_sockets();
  open();
  std::vector<int> opened;
  const std::set<int> after = receiving_sockets();
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(opened));
  // Two, where another thread opened one at the same time: no filter rather than the wrong one's.
  if (opened.size() == 1) socket_ = opened.front();
}

void ChannelFilter::add(const std::string& channel) {
  channels_.push_back(channel);
  attach();
}

void ChannelFilter::remove(const std::string& channel) {
  std::erase(channels_, channel);
  attach();
}

void ChannelFilter::pass_all() {
  passes_all_ = true;
  if (!socket_) return;
  int unused = 0;
  // It fails if there is no filter yet.
  (void)setsockopt(*socket_, SOL_SOCKET, SO_DETACH_FILTER, &unused, sizeof unused);
}

void ChannelFilter::attach() {
  if (passes_all_ || !socket_) return;
  std::vector<sock_filter> code = make_channel_filter(channels_);
  if (code.empty()) return pass_all();
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  // A kernel without the filter passes all, as LCM alone does.
  (void)setsockopt(*socket_, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program);
}

}  // namespace nao
