#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nao {

/** A message of LCM in one datagram. */
struct WholeMessage {
  std::string_view channel;
  std::span<const uint8_t> bytes;
};

/** @return What a datagram holds, valid as long as it; nothing for a fragment, or what is no
 * message. Layout: LCM's "UDP Multicast Protocol Description". */
std::optional<WholeMessage> parse_datagram(std::span<const uint8_t> datagram);

/** Receives the messages of one bus that come in one datagram, on selected channels: with LCM's own
 * thread each of them would wake two threads. LCM receives only fragments, which say in their first
 * datagram only on what channel they are. */
class BusSocket {
 public:
  BusSocket() = default;
  ~BusSocket();
  BusSocket(const BusSocket&) = delete;
  BusSocket& operator=(const BusSocket&) = delete;

  /** Makes LCM open its receiving socket, and opens another one at its port. Without effect after
   * the first call. Other buses (of a memory, of a file) have no socket.
   * @param open_lcm  Makes LCM open its socket, whose messages can be waited for at the descriptor
   * that it returns. */
  void open(const std::function<int()>& open_lcm);

  /** Descriptor that is readable while a datagram waits here or LCM has a message; -1: LCM receives
   * everything. */
  int descriptor() const { return either_; }

  /** Receives messages on this channel. */
  void add(const std::string& channel);
  /** Ends add(). */
  void remove(const std::string& channel);
  /** From now on LCM receives everything. */
  void leave_to_lcm();

  struct Waiting {
    /** receive() has a message, or a datagram that is none. */
    bool is_here = false;
    /** LCM has one, or may have one. */
    bool is_at_lcm = false;
  };
  /** Where messages wait now: one system call for both. */
  Waiting waiting() const;

  /** @return The next message that waits, valid until the next call; nothing if none does. */
  std::optional<WholeMessage> receive();

 private:
  void filter();

  bool is_opened_ = false;
  bool is_left_to_lcm_ = false;
  /** -1: none. The socket; LCM's; one that is readable while any of both is (epoll). */
  int socket_ = -1;
  int lcm_socket_ = -1;
  int either_ = -1;
  std::vector<std::string> channels_;
  std::vector<uint8_t> buffer_;
};

}  // namespace nao
