#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "phone-gateway/server/core/sessions.h"

namespace nao::gateway {

/** The sessions of the clients that watch one robot. */
class RobotSessions {
 public:
  /** @param robot  Index of the robot.
   * @param label  Name of the robot for the audit log; empty: the gateway has only this one.
   * `sessions` must outlive this. */
  RobotSessions(Sessions& sessions, size_t robot, std::string label)
      : sessions_(sessions), robot_(robot), label_(std::move(label)) {}

  size_t robot() const { return robot_; }
  const std::string& label() const { return label_; }

  /** @return nullptr if there is no such session, or it watches another robot. */
  ClientSession* find(uint32_t client) const {
    ClientSession* session = sessions_.find(client);
    return session != nullptr && session->robot == robot_ ? session : nullptr;
  }

  /** Calls `act` with each connected client's session. */
  template <class Act>
  void for_each(Act act) const {
    for (const auto& [id, session] : sessions_.all()) {
      if (session->is_connected && session->robot == robot_) act(*session);
    }
  }

  /** Whether one connected client's session fulfils a condition. */
  template <class Condition>
  bool has_any(Condition condition) const {
    return std::ranges::any_of(sessions_.all(), [&](const auto& item) {
      const ClientSession& session = *item.second;
      return session.is_connected && session.robot == robot_ && condition(session);
    });
  }

  /** Sends a message to every connected client. */
  void broadcast(const naoremote::ServerMessage& message) const {
    // Encoded once for all clients.
    const MessageBytes bytes = encode(message);
    for_each([&bytes](ClientSession& session) { session.send(bytes); });
  }

  /** The sessions of all robots. */
  Sessions& all() const { return sessions_; }

 private:
  Sessions& sessions_;
  size_t robot_;
  std::string label_;
};

}  // namespace nao::gateway
