#include "lola/socket.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/error.h"

namespace nao {
namespace {

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path) {
    throw Error(fmt::format("the socket's path \"{}\" has {} characters; it must have 1 to {}",
                            path, path.size(), sizeof address.sun_path - 1));
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

UnixSocket make_socket() {
  UnixSocket result(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!result.is_open()) throw Error(std::string("cannot make a socket: ") + std::strerror(errno));
  return result;
}

/** @return 0, or the error's number. */
int connect_to(const sockaddr_un& address, const UnixSocket& socket) {
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  return connect(socket.descriptor(), generic, sizeof address) == 0 ? 0 : errno;
}

}  // namespace

UnixSocket::~UnixSocket() {
  if (descriptor_ >= 0) close(descriptor_);
}

UnixSocket::UnixSocket(UnixSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

UnixSocket& UnixSocket::operator=(UnixSocket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

// A socket's file outlives its program. If no program answers at it, it is removed; if one does,
// that program must not be cut off.
UnixSocket UnixSocket::listen(const std::string& path) {
  const sockaddr_un address = address_of(path);
  const int error = connect_to(address, make_socket());
  // EAGAIN: its queue of waiting clients is full.
  if (error == 0 || error == EAGAIN) {
    throw Error("another program listens at " + path + " already");
  }
  std::error_code ignored;
  // Only a socket is removed, never another file of that name.
  if (error == ECONNREFUSED && std::filesystem::is_socket(path, ignored)) unlink(path.c_str());
  UnixSocket result = make_socket();
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  if (bind(result.descriptor(), generic, sizeof address) != 0 ||
      ::listen(result.descriptor(), 1) != 0) {
    throw Error(fmt::format("cannot listen at {}: {}", path, std::strerror(errno)));
  }
  return result;
}

std::optional<UnixSocket> UnixSocket::accept() const {
  UnixSocket client(accept4(descriptor_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client.is_open()) return std::nullopt;
  return client;
}

std::optional<UnixSocket> UnixSocket::connect(const std::string& path) {
  const sockaddr_un address = address_of(path);
  UnixSocket result = make_socket();
  if (connect_to(address, result) != 0) return std::nullopt;
  return result;
}

template <class Incoming>
void LolaConnection<Incoming>::receive() {
  if (!end_.empty()) return;
  // Without free memory next() has found an error, or the caller does not take messages out.
  const std::span<uint8_t> memory = stream_.free_memory();
  if (memory.empty()) return;
  const ssize_t num_bytes = recv(socket_.descriptor(), memory.data(), memory.size(), 0);
  if (num_bytes > 0) {
    stream_.note_received(static_cast<size_t>(num_bytes));
  } else if (num_bytes == 0) {
    end_ = "the other end has closed the connection";
  } else if (errno != EAGAIN && errno != EINTR) {
    end_ = std::string("cannot read: ") + std::strerror(errno);
  }
}

template <class Incoming>
bool LolaConnection<Incoming>::next(Incoming& message) {
  if (stream_.next(message)) return true;
  if (end_.empty() && !stream_.error().empty()) end_ = "unreadable message: " + stream_.error();
  return false;
}

template <class Incoming>
void LolaConnection<Incoming>::send(std::span<const uint8_t> message) {
  if (!end_.empty()) return;
  // MSG_NOSIGNAL: a closed connection is an error here, not SIGPIPE. A message that fits only in
  // part means that the other end has stopped reading; a later one would be out of step.
  const ssize_t num_bytes =
      ::send(socket_.descriptor(), message.data(), message.size(), MSG_NOSIGNAL);
  if (num_bytes == static_cast<ssize_t>(message.size())) return;
  end_ = num_bytes < 0 && errno != EAGAIN ? std::string("cannot write: ") + std::strerror(errno)
                                          : "the other end does not read";
}

template class LolaConnection<LolaState>;
template class LolaConnection<LolaCommand>;

}  // namespace nao
