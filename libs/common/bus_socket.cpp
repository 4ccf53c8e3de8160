#include "common/bus_socket.h"

#include <netinet/in.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>

#include "common/channel_filter.h"

namespace nao {
namespace {

/** First bytes of a message in one datagram, and of those with the sequence number after them. */
constexpr std::string_view kMagic = "LC02";
constexpr size_t kHeaderSize = 8;
/** Most bytes of a UDP datagram. */
constexpr size_t kMostBytes = 65507;
/** Memory of the kernel for waiting datagrams, bytes. Chosen: a second of a robot's messages; the
 * kernel grants as much as it allows. */
constexpr int kWaitingBytes = 1 << 20;

/** A socket's address if it is a UDP socket whose port others may use, too: LCM's receiving socket,
 * in contrast to its sending one, of which the kernel has chosen the port. */
std::optional<sockaddr_in> receiving_address(int descriptor) {
  int value = 0;
  socklen_t size = sizeof value;
  if (getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &value, &size) != 0 || value != SOCK_DGRAM) {
    return std::nullopt;
  }
  size = sizeof value;
  if (getsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &value, &size) != 0 || value == 0) {
    return std::nullopt;
  }
  sockaddr_in address{};
  size = sizeof address;
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0 ||
      address.sin_family != AF_INET || address.sin_port == 0) {
    return std::nullopt;
  }
  return address;
}

std::set<int> receiving_sockets() {
  std::set<int> result;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const int descriptor = std::stoi(entry.path().filename());
    if (receiving_address(descriptor)) result.insert(descriptor);
  }
  return result;
}

bool attach(int socket, const std::vector<std::string>& channels) {
  std::vector<sock_filter> code = make_channel_filter(channels);
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  return !code.empty() &&
         setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0;
}

/** A socket that receives what another one does, without whole messages yet. It need not join the
 * group: ip(7), IP_MULTICAST_ALL. @return -1  if the system refuses it. */
int open_beside(const sockaddr_in& address) {
  const int result = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (result < 0) return -1;
  const int yes = 1;
  (void)setsockopt(result, SOL_SOCKET, SO_RCVBUF, &kWaitingBytes, sizeof kWaitingBytes);
  if (setsockopt(result, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 && attach(result, {}) &&
      bind(result, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return result;
  }
  close(result);
  return -1;
}

int watch(const std::vector<int>& descriptors) {
  const int result = epoll_create1(EPOLL_CLOEXEC);
  for (const int descriptor : descriptors) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = descriptor;
    (void)epoll_ctl(result, EPOLL_CTL_ADD, descriptor, &event);
  }
  return result;
}

}  // namespace

std::optional<WholeMessage> parse_datagram(std::span<const uint8_t> datagram) {
  if (datagram.size() < kHeaderSize || std::memcmp(datagram.data(), kMagic.data(), 4) != 0) {
    return std::nullopt;
  }
  const auto rest = datagram.subspan(kHeaderSize);
  const auto end = std::find(rest.begin(), rest.end(), 0);
  if (end == rest.end()) return std::nullopt;
  const auto size = static_cast<size_t>(end - rest.begin());
  return WholeMessage{{reinterpret_cast<const char*>(rest.data()), size}, rest.subspan(size + 1)};
}

BusSocket::~BusSocket() {
  if (socket_ >= 0) close(socket_);
  if (either_ >= 0) close(either_);
}

void BusSocket::open(const std::function<int()>& open_lcm) {
  if (is_opened_) return;
  is_opened_ = true;
  const std::set<int> before = receiving_sockets();
  const int of_lcm = open_lcm();
  std::vector<int> opened;
  const std::set<int> after = receiving_sockets();
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(opened));
  // Two, where another thread opened one at the same time: LCM's rather than the wrong one.
  if (opened.size() != 1) return;
  // First, so that no message comes by both.
  if (!attach(opened.front(), {})) return;
  lcm_socket_ = opened.front();
  socket_ = open_beside(*receiving_address(lcm_socket_));
  if (socket_ < 0) return leave_to_lcm();
  buffer_.resize(kMostBytes);
  either_ = watch({socket_, of_lcm});
}

void BusSocket::add(const std::string& channel) {
  channels_.push_back(channel);
  filter();
}

void BusSocket::remove(const std::string& channel) {
  std::erase(channels_, channel);
  filter();
}

void BusSocket::filter() {
  if (socket_ < 0 || is_left_to_lcm_) return;
  if (!attach(socket_, channels_)) leave_to_lcm();
}

void BusSocket::leave_to_lcm() {
  is_left_to_lcm_ = true;
  // First, so that no message comes by both.
  if (socket_ >= 0) (void)attach(socket_, {});
  int unused = 0;
  if (lcm_socket_ >= 0) {
    (void)setsockopt(lcm_socket_, SOL_SOCKET, SO_DETACH_FILTER, &unused, sizeof unused);
  }
}

BusSocket::Waiting BusSocket::waiting() const {
  if (either_ < 0) return {false, true};
  std::array<epoll_event, 2> events{};
  const int num = epoll_wait(either_, events.data(), static_cast<int>(events.size()), 0);
  Waiting result;
  for (int i = 0; i < num; ++i) {
    (events[static_cast<size_t>(i)].data.fd == socket_ ? result.is_here : result.is_at_lcm) = true;
  }
  return result;
}

std::optional<WholeMessage> BusSocket::receive() {
  while (socket_ >= 0) {
    const ssize_t size = recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (size < 0) break;
    if (auto message = parse_datagram({buffer_.data(), static_cast<size_t>(size)})) return message;
  }
  return std::nullopt;
}

}  // namespace nao
