#pragma once

#include <optional>
#include <string>
#include <string_view>

// What is asked of nao-relay, by the target of a WebSocket:
//   /ws?robot=ROBOT    a phone, for a robot (32 hexadecimal digits)
//   /ws?key=KEY        a gateway that takes phones of the robot whose key this is (64 digits). Each
//                      text message that it receives is the ticket of a phone that waits
//   /ws?ticket=TICKET  that gateway, to be connected with the phone (32 digits)

namespace nao {

inline constexpr size_t kRobotKeyBytes = 32;
inline constexpr size_t kRobotIdBytes = 16;
inline constexpr size_t kTicketBytes = 16;

/** A target of nao-relay that is well-formed. */
struct RelayTarget {
  enum class Kind { kPhone, kRobot, kTicket };
  Kind kind = Kind::kPhone;
  /** Robot, key or ticket, hexadecimal. */
  std::string value;
};
[[nodiscard]] std::optional<RelayTarget> parse_relay_target(std::string_view target);

/** The target that parse_relay_target() reads. */
std::string write_relay_target(const RelayTarget& target);

/** The robot of a key: the first half of its SHA-256. Who does not know the key cannot take its
 * place at the relay. Both hexadecimal. @throws Error  OpenSSL fails. */
std::string robot_of_key(const std::string& key);

}  // namespace nao
