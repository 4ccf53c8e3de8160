#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "common/event_loop.h"
#include "lola/socket.h"

namespace nao::sim {

/** Serves LoLA on a Unix stream socket, to one client at a time: others wait until it has gone. */
class LolaServer {
 public:
  /** Functions that the user of a server provides. */
  struct Handlers {
    /** A client has connected; it expects a state without asking. */
    std::function<void()> on_client;
    std::function<void(const LolaCommand&)> on_command;
  };

  /** Listens; a socket file that is left from a crash is replaced. The loop must outlive this.
   * @throws Error */
  LolaServer(EventLoop& loop, std::string path, Handlers handlers);
  ~LolaServer();
  LolaServer(const LolaServer&) = delete;
  LolaServer& operator=(const LolaServer&) = delete;

  bool has_client() const { return client_.has_value(); }
  /** Sends a frame, if there is a client. A client that does not read is disconnected. */
  void send(const LolaState& state);

 private:
  void accept();
  void read();
  void drop();

  EventLoop& loop_;
  std::string path_;
  Handlers handlers_;
  UnixSocket listener_;
  std::optional<LolaConnection<LolaCommand>> client_;
  std::array<uint8_t, kLolaStateBytes> frame_;
};

}  // namespace nao::sim
