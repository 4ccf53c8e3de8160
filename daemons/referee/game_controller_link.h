#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "daemons/referee/game_controller_message.h"

namespace nao::referee {

/** The UDP socket between robots and a GameController. Answers go to the host of the sender that
 * was accepted last. */
class GameControllerLink {
 public:
  /** @param port  For the GameController's messages; 0: any free one. Others on this host may use
   * it, too. @param return_port  Port of the GameController, for those of the robots.
   * @throws Error  if the port cannot be opened. */
  GameControllerLink(uint16_t port, uint16_t return_port);
  ~GameControllerLink();
  GameControllerLink(const GameControllerLink&) = delete;
  GameControllerLink& operator=(const GameControllerLink&) = delete;

  int descriptor() const { return socket_; }
  uint16_t port() const;
  /** The next waiting datagram; nothing if there is none. */
  std::optional<std::vector<uint8_t>> receive();
  /** Whether that datagram came from the GameController. A GameController that is started again has
   * another port. */
  bool is_from_controller() const;
  /** Addresses with port, such as "10.0.0.5:4711", of that datagram's sender and of the
   * GameController. */
  std::string sender() const;
  std::string controller() const;
  /** The sender of that datagram is the GameController. */
  void accept_sender() { controller_ = sender_; }
  /** Sends to the GameController, if there is one. */
  void send(std::span<const uint8_t> message) const;

 private:
  int socket_;
  uint16_t return_port_;
  sockaddr_in sender_{};
  std::optional<sockaddr_in> controller_{};
};

}  // namespace nao::referee
