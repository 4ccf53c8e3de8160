#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace nao::relay {

/** What a relay holds at most. */
struct RelayLimits {
  int max_phones = 1000;
  int max_robots = 100;
  /** As many clients as a gateway admits. */
  int max_phones_per_robot = 128;
  /** Chosen: a school behind one address. */
  int max_phones_per_address = 256;
  int max_robots_per_address = 20;
  /** Time in which a robot's gateway must fetch a phone, s: as for a handshake. */
  double ticket_timeout = 5;
};

/** Who is connected with whom. Has no socket and no clock: times are s of a clock that never runs
 * backwards. */
class RelayCore {
 public:
  /** A refusal: one sentence for the other end. */
  using Refused = std::string;
  /** A phone that waits until its robot's gateway comes with the ticket. */
  struct Waiting {
    uint32_t phone = 0;
    std::string ticket;
  };

  /** @param make_ticket  A new one that cannot be guessed. */
  RelayCore(const RelayLimits& limits, std::function<std::string()> make_ticket)
      : limits_(limits), make_ticket_(std::move(make_ticket)) {}

  /** A gateway offers a robot. One that is known replaces the connection of before.
   * @return The number of the connection. */
  std::variant<uint32_t, Refused> add_robot(const std::string& robot, const std::string& address);
  /** That connection has ended. No effect if another one has replaced it. */
  void remove_robot(const std::string& robot, uint32_t connection);
  /** The newest connection of a robot; 0: it has none. */
  uint32_t robot_connection(const std::string& robot) const;

  /** A phone asks for a robot. */
  std::variant<Waiting, Refused> add_phone(const std::string& robot, const std::string& address,
                                           double now);
  /** A gateway comes with a ticket. @return The phone; 0: no phone waits with it. */
  uint32_t take_ticket(const std::string& ticket);
  void remove_phone(uint32_t phone);
  /** Phones whose gateway has not come in time; they are to be closed and removed. */
  std::vector<uint32_t> late_phones(double now) const;

  size_t num_phones() const { return phones_.size(); }
  size_t num_robots() const { return robots_.size(); }

 private:
  struct Robot {
    uint32_t connection = 0;
    std::string address;
  };
  struct Phone {
    std::string robot;
    std::string address;
    /** Empty once it was taken. */
    std::string ticket;
    double came = 0;
  };

  RelayLimits limits_;
  std::function<std::string()> make_ticket_;
  std::map<std::string, Robot> robots_;
  std::map<uint32_t, Phone> phones_;
  uint32_t last_number_ = 0;
};

}  // namespace nao::relay
