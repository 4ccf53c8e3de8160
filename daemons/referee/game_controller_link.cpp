#include "daemons/referee/game_controller_link.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "common/error.h"

namespace nao::referee {
namespace {

std::string text_of(const sockaddr_in& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
  return std::string(text.data()) + ":" + std::to_string(ntohs(address.sin_port));
}

}  // namespace

GameControllerLink::GameControllerLink(uint16_t port, uint16_t return_port)
    : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)),
      return_port_(return_port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  address.sin_port = htons(port);
  const int one = 1;
  // Broadcasts reach every socket of the port.
  (void)setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const std::string why = std::strerror(errno);
    close(socket_);
    throw Error("cannot listen to the GameController at UDP port " + std::to_string(port) + ": " +
                why);
  }
}

GameControllerLink::~GameControllerLink() {
  close(socket_);
}

uint16_t GameControllerLink::port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  (void)getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

std::optional<std::vector<uint8_t>> GameControllerLink::receive() {
  // The buffer is longer than any message; a longer datagram is cut and still has the wrong size.
  std::vector<uint8_t> bytes(1024);
  socklen_t size = sizeof sender_;
  const ssize_t count = recvfrom(socket_, bytes.data(), bytes.size(), 0,
                                 reinterpret_cast<sockaddr*>(&sender_), &size);
  if (count < 0) return std::nullopt;
  bytes.resize(static_cast<size_t>(count));
  return bytes;
}

bool GameControllerLink::is_from_controller() const {
  return controller_ && controller_->sin_addr.s_addr == sender_.sin_addr.s_addr &&
         controller_->sin_port == sender_.sin_port;
}

std::string GameControllerLink::sender() const {
  return text_of(sender_);
}

std::string GameControllerLink::controller() const {
  return controller_ ? text_of(*controller_) : "";
}

void GameControllerLink::send(std::span<const uint8_t> message) const {
  if (!controller_) return;
  sockaddr_in address = *controller_;
  address.sin_port = htons(return_port_);
  // A GameController that is not running misses it; the next message comes soon.
  (void)sendto(socket_, message.data(), message.size(), 0,
               reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

}  // namespace nao::referee
