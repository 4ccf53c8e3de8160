#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "lola/codec.h"

namespace nao {

/** A descriptor of a Unix stream socket, closed at the end. */
class UnixSocket {
 public:
  explicit UnixSocket(int descriptor = -1) : descriptor_(descriptor) {}
  ~UnixSocket();
  UnixSocket(UnixSocket&& other) noexcept;
  UnixSocket& operator=(UnixSocket&& other) noexcept;

  int descriptor() const { return descriptor_; }
  bool is_open() const { return descriptor_ >= 0; }

  /** Listens at a path, where no other program may listen. A socket file that a crashed program has
   * left there is replaced. @throws Error */
  static UnixSocket listen(const std::string& path);
  /** @return The next client that waits; nothing if none does. */
  std::optional<UnixSocket> accept() const;
  /** @return Nothing if nobody listens at the path. @throws Error  if the path is too long. */
  static std::optional<UnixSocket> connect(const std::string& path);

 private:
  int descriptor_;
};

/** One end of a LoLA connection, which never blocks. @tparam Incoming  LolaState for a client,
 * LolaCommand for a server. */
template <class Incoming>
class LolaConnection {
 public:
  explicit LolaConnection(UnixSocket socket) : socket_(std::move(socket)) {}

  int descriptor() const { return socket_.descriptor(); }

  /** Takes the bytes that have arrived, as far as there is memory. Call it when the descriptor is
   * readable, and then next() until there is no message. */
  void receive();
  /** @return Whether there was a message. */
  bool next(Incoming& message);
  /** Sends a whole message. A client or server that does not read until the socket's memory is full
   * counts as gone. */
  void send(std::span<const uint8_t> message);

  /** Why the connection cannot be used any more; empty while it can. Messages that arrived before
   * can still be read. */
  const std::string& end() const { return end_; }

 private:
  UnixSocket socket_;
  LolaStream<Incoming> stream_;
  std::string end_;
};

extern template class LolaConnection<LolaState>;
extern template class LolaConnection<LolaCommand>;

}  // namespace nao
