#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace nao::foxglove {

/** Turns what clients publish into commands on the bus: those that any program may send, such as
 * NAO_WALK_COMMAND and WORLD_COMMAND, but not the joint commands of the motion program. Sender and
 * times are filled in here. */
class ClientPublisher {
 public:
  using Clock = std::function<int64_t()>;
  using Send = std::function<void(const std::string& channel, std::span<const uint8_t> message)>;

  /** @param source  Beginning of the senders' names. @param robot  Name of the robot, "NAO".
   * @param clock  Microseconds since 1970. @param robot_clock  Robot time, microseconds. */
  ClientPublisher(std::string source, std::string robot, Clock clock, Clock robot_clock, Send send);

  /** Whether clients may publish on a channel. @param encoding  Of the messages.
   * @return Why they may not, as a sentence; "" if they may. */
  std::string check(const std::string& channel, const std::string& encoding) const;

  /** Sends a message. Absent fields are 0 or empty; an absent `command_id` makes the message a new
   * command, or, within the validity of a repeated command (walk, play), a repetition of it.
   * @param client  Number of the client. @param channel  That passed check().
   * @param json  The message as a JSON object. @return What is wrong with it, as a sentence; "". */
  std::string publish(uint32_t client, const std::string& channel, std::string_view json);

 private:
  /** Name of the type of a channel's messages; "" if nobody may publish there. */
  std::string type_of(const std::string& channel) const;

  /** The id of a message without one. */
  int64_t command_id(uint32_t client, const std::string& channel);

  std::string source_;
  std::string robot_;
  Clock clock_;
  Clock robot_clock_;
  Send send_;
  int64_t last_id_ = 0;
  /** A repeated command that has not ended. */
  struct Repeated {
    int64_t id = 0;
    /** When it ends unless it is repeated, microseconds since 1970. */
    int64_t end_utime = 0;
  };
  std::map<std::pair<uint32_t, std::string>, Repeated> repeated_;
};

}  // namespace nao::foxglove
