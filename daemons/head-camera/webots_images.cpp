#include "daemons/head-camera/webots_images.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "common/error.h"
#include "daemons/head-camera/image_requests.h"
#include "daemons/head-camera/yuyv.h"

namespace nao::camera {
namespace {

constexpr size_t kWebotsHeaderBytes = 16;
constexpr size_t kPixelBytes = static_cast<size_t>(2) * kFullWidth * kFullHeight;
constexpr uint8_t kMagic[8] = {'w', 'b', 'i', 'm', 'a', 'g', 'e', 0};
/** LoLA's cycle, microseconds. */
constexpr int64_t kCycle = 12000;
/** Clients of one camera. Chosen: the original has one. */
constexpr size_t kMaxClients = 4;
/** Time for a client to take an image, ms: a third of the interval between two. */
constexpr int kWait = 10;
/** Time after which a client that takes nothing counts as gone, s. Chosen. */
constexpr double kClientTime = 1.0;

void write_uint16(uint8_t* target, int64_t value) {
  target[0] = static_cast<uint8_t>(value);
  target[1] = static_cast<uint8_t>(value >> 8);
}

[[noreturn]] void fail(uint16_t port) {
  throw Error("--webots-images: cannot listen on port " + std::to_string(port) + ": " +
              std::strerror(errno) + "; choose another one");
}

}  // namespace

WebotsImages::WebotsImages(const std::vector<std::string>& cameras, uint16_t port)
    : message_(kWebotsHeaderBytes + kPixelBytes) {
  for (const std::string& camera : cameras) {
    const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    // It enters the list at once, so that it is closed in any case.
    servers_.push_back({camera, descriptor, port, {}});
    const int yes = 1;
    setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    if (descriptor < 0 || bind(descriptor, generic, size) != 0 ||
        listen(descriptor, static_cast<int>(kMaxClients)) != 0 ||
        getsockname(descriptor, generic, &size) != 0) {
      const int fault = errno;
      for (const Server& server : servers_) close(server.descriptor);
      errno = fault;
      fail(port);
    }
    servers_.back().port = ntohs(address.sin_port);
    if (port != 0) ++port;
  }
}

WebotsImages::~WebotsImages() {
  for (const Server& server : servers_) {
    for (const Client& client : server.clients) close(client.descriptor);
    close(server.descriptor);
  }
}

WebotsImages::Server* WebotsImages::find(const std::string& camera) {
  const auto found = std::find_if(servers_.begin(), servers_.end(),
                                  [&](const Server& server) { return server.camera == camera; });
  return found != servers_.end() ? &*found : nullptr;
}

bool WebotsImages::has_clients(const std::string& camera) {
  Server* server = find(camera);
  if (server == nullptr) return false;
  while (true) {
    const int descriptor =
        accept4(server->descriptor, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (descriptor < 0) break;
    if (server->clients.size() == kMaxClients) {
      close(descriptor);
      continue;
    }
    const int yes = 1;
    setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const auto memory = static_cast<int>(kWebotsHeaderBytes + kPixelBytes);
    setsockopt(descriptor, SOL_SOCKET, SO_SNDBUF, &memory, sizeof memory);
    server->clients.push_back({descriptor, 0, {}, -1});
  }
  return !server->clients.empty();
}

// Bytes that do not fit into the socket's memory wait for the client, but not longer than
// `wait_ms`.
bool WebotsImages::continue_sending(Client& client, double now, int wait_ms) {
  while (client.num_sent < client.message.size()) {
    const ssize_t count = ::send(client.descriptor, client.message.data() + client.num_sent,
                                 client.message.size() - client.num_sent, MSG_NOSIGNAL);
    if (count > 0) {
      client.num_sent += static_cast<size_t>(count);
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN && errno != EWOULDBLOCK) return false;
    pollfd writable{client.descriptor, POLLOUT, 0};
    if (poll(&writable, 1, wait_ms) <= 0) return now - client.last_time < kClientTime;
  }
  client.last_time = now;
  return true;
}

void WebotsImages::send(const CameraFrame& frame, double now) {
  Server* server = find(frame.camera);
  if (server == nullptr || server->clients.empty()) return;
  std::copy(std::begin(kMagic), std::end(kMagic), message_.begin());
  write_uint16(&message_[8], frame.utime / kCycle);
  message_[10] = static_cast<uint8_t>(server - servers_.data());
  message_[11] = 2;
  write_uint16(&message_[12], kFullWidth);
  write_uint16(&message_[14], kFullHeight);
  bgrx_to_yuyv(frame.bgrx[0], kFullWidth, kFullHeight,
               std::span(message_).subspan(kWebotsHeaderBytes));
  std::erase_if(server->clients, [&](Client& client) {
    if (client.last_time < 0) client.last_time = now;
    // The server does not wait again for a client that still has to take the last image.
    bool is_there = true;
    if (client.num_sent < client.message.size()) is_there = continue_sending(client, now, 0);
    if (is_there && client.num_sent == client.message.size()) {
      client.message = message_;
      client.num_sent = 0;
      is_there = continue_sending(client, now, kWait);
    }
    if (!is_there) close(client.descriptor);
    return !is_there;
  });
}

}  // namespace nao::camera
