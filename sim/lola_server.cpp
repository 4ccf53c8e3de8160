#include "sim/lola_server.h"

#include <unistd.h>

#include <utility>

#include "common/logger.h"

namespace nao::sim {

// LoLA serves one client at a time. While it is connected the listener is not watched.
LolaServer::LolaServer(EventLoop& loop, std::string path, Handlers handlers)
    : loop_(loop),
      path_(std::move(path)),
      handlers_(std::move(handlers)),
      listener_(UnixSocket::listen(path_)) {
  loop_.on_readable(listener_.descriptor(), [this] { accept(); });
}

// The socket's file would otherwise stay and let a later client believe in a running robot.
LolaServer::~LolaServer() {
  if (client_) loop_.forget(client_->descriptor());
  loop_.forget(listener_.descriptor());
  unlink(path_.c_str());
}

void LolaServer::accept() {
  auto socket = listener_.accept();
  if (!socket) return;
  // The next client waits in the socket's queue.
  loop_.forget(listener_.descriptor());
  client_.emplace(std::move(*socket));
  logger::info("LoLA client connected");
  loop_.on_readable(client_->descriptor(), [this] { read(); });
  handlers_.on_client();
}

void LolaServer::read() {
  client_->receive();
  LolaCommand command;
  // A command may make the simulator send a frame, which may end the connection.
  // next() takes complete messages out of the receive buffer; a partial one waits for more bytes.
  while (client_ && client_->next(command)) handlers_.on_command(command);
  // end() is the reason for which the connection ended; empty while it is open.
  if (client_ && !client_->end().empty()) drop();
}

// Encodes into a buffer that is used again for every frame.
void LolaServer::send(const LolaState& state) {
  if (!client_) return;
  const size_t size = encode(state, frame_);
  client_->send(std::span(frame_).first(size));
  if (!client_->end().empty()) drop();
}

void LolaServer::drop() {
  logger::info("LoLA client left: {}; the servos hold their targets", client_->end());
  loop_.forget(client_->descriptor());
  client_.reset();
  loop_.on_readable(listener_.descriptor(), [this] { accept(); });
}

}  // namespace nao::sim
