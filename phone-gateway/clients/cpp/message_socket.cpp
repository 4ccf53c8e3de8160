#include "phone-gateway/clients/cpp/message_socket.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "common/wall_clock.h"

namespace nao {
namespace {

/** s; the gateway disconnects a client after as long a silence. */
constexpr double kSendTimeout = 5;

/** Waits until a descriptor is ready. @return false after the timeout, s. */
bool wait_for(int descriptor, short events, double timeout) {
  pollfd polled{descriptor, events, 0};
  // poll() takes milliseconds; 0 asks without waiting.
  const int timeout_ms = static_cast<int>(std::max(0.0, timeout) * 1e3);
  return poll(&polled, 1, timeout_ms) > 0;
}

/** Connects to one address. @return The descriptor, or -1 with errno set. */
int connect_to(const addrinfo& address, double timeout) {
  const int descriptor = socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (descriptor < 0) return -1;
  int error = 0;
  if (connect(descriptor, address.ai_addr, address.ai_addrlen) != 0) {
    error = errno;
    // Not blocking, so that an unreachable address fails after this timeout instead of the kernel's
    // minutes; SO_ERROR then has the outcome (connect(2)).
    if (error == EINPROGRESS) {
      socklen_t size = sizeof error;
      if (!wait_for(descriptor, POLLOUT, timeout)) {
        error = ETIMEDOUT;
      } else if (getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size) != 0) {
        error = errno;
      }
    }
  }
  if (error == 0) return descriptor;
  close(descriptor);
  errno = error;
  return -1;
}

}  // namespace

MessageSocket::MessageSocket(const std::string& host, uint16_t port, double timeout) {
  const std::string where = host + " port " + std::to_string(port);
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int status = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (status != 0) throw ConnectionError("no such host: " + host + ": " + gai_strerror(status));
  // Freed on every way out.
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, freeaddrinfo);
  // A name may have IPv6 and IPv4 addresses: the first that answers.
  for (const addrinfo* address = found; address != nullptr; address = address->ai_next) {
    descriptor_ = connect_to(*address, timeout);
    if (descriptor_ >= 0) break;
  }
  if (descriptor_ < 0) {
    throw ConnectionError("no gateway at " + where + ": " + std::strerror(errno));
  }
  const int on = 1;
  // Commands are small: Nagle's algorithm would hold them back until the last one is acknowledged.
  setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

MessageSocket::~MessageSocket() {
  close(descriptor_);
}

void MessageSocket::send(std::string_view message) {
  send_raw(frame(message));
}

void MessageSocket::send_raw(std::string_view bytes) {
  while (!bytes.empty()) {
    // MSG_NOSIGNAL: a lost connection is an error, not a SIGPIPE that ends the program.
    const ssize_t size = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (size >= 0) {
      bytes.remove_prefix(static_cast<size_t>(size));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!wait_for(descriptor_, POLLOUT, kSendTimeout)) {
        throw ConnectionError("the gateway does not read");
      }
    } else if (errno != EINTR) {
      throw ConnectionError(std::string("the connection is lost: ") + std::strerror(errno));
    }
  }
}

std::optional<std::string> MessageSocket::receive(double timeout) {
  const double deadline = monotonic_seconds() + timeout;
  // Bytes that have come before may hold several messages.
  while (true) {
    if (std::optional<std::string> message = reader_.next()) return message;
    if (reader_.is_oversized()) throw ConnectionError("the program on this port is not a gateway");
    if (!wait_for(descriptor_, POLLIN, deadline - monotonic_seconds())) return std::nullopt;
    std::array<char, 65536> bytes;
    const ssize_t size = recv(descriptor_, bytes.data(), bytes.size(), 0);
    if (size == 0) throw ConnectionError("the gateway closed the connection");
    if (size > 0) {
      reader_.add({bytes.data(), static_cast<size_t>(size)});
    } else if (errno != EAGAIN && errno != EINTR) {
      throw ConnectionError(std::string("the connection is lost: ") + std::strerror(errno));
    }
  }
}

}  // namespace nao
