#include "phone-gateway/relay/relay_core.h"

#include <algorithm>

namespace nao::relay {
namespace {

template <class Map, class Condition>
int count_where(const Map& map, Condition condition) {
  return static_cast<int>(std::count_if(map.begin(), map.end(),
                                        [&](const auto& item) { return condition(item.second); }));
}

}  // namespace

std::variant<uint32_t, RelayCore::Refused> RelayCore::add_robot(const std::string& robot,
                                                                const std::string& address) {
  if (robots_.count(robot) == 0) {
    if (static_cast<int>(robots_.size()) >= limits_.max_robots) {
      return "The relay has its " + std::to_string(limits_.max_robots) + " robots already.";
    }
    const auto has_address = [&](const Robot& other) { return other.address == address; };
    if (count_where(robots_, has_address) >= limits_.max_robots_per_address) {
      return "One address may offer " + std::to_string(limits_.max_robots_per_address) + " robots.";
    }
  }
  robots_[robot] = {++last_number_, address};
  return last_number_;
}

void RelayCore::remove_robot(const std::string& robot, uint32_t connection) {
  if (robot_connection(robot) == connection) robots_.erase(robot);
}

uint32_t RelayCore::robot_connection(const std::string& robot) const {
  const auto found = robots_.find(robot);
  return found == robots_.end() ? 0 : found->second.connection;
}

std::variant<RelayCore::Waiting, RelayCore::Refused> RelayCore::add_phone(
    const std::string& robot, const std::string& address, double now) {
  if (robot_connection(robot) == 0) return "The robot is not connected with the relay.";
  if (static_cast<int>(phones_.size()) >= limits_.max_phones) {
    return "The relay has its " + std::to_string(limits_.max_phones) + " phones already.";
  }
  const auto has_robot = [&](const Phone& phone) { return phone.robot == robot; };
  if (count_where(phones_, has_robot) >= limits_.max_phones_per_robot) {
    return "The robot has its " + std::to_string(limits_.max_phones_per_robot) + " phones already.";
  }
  const auto has_address = [&](const Phone& phone) { return phone.address == address; };
  if (count_where(phones_, has_address) >= limits_.max_phones_per_address) {
    return "One address may connect " + std::to_string(limits_.max_phones_per_address) + " phones.";
  }
  Waiting waiting{++last_number_, make_ticket_()};
  phones_[waiting.phone] = {robot, address, waiting.ticket, now};
  return waiting;
}

uint32_t RelayCore::take_ticket(const std::string& ticket) {
  if (ticket.empty()) return 0;
  for (auto& [number, phone] : phones_) {
    if (phone.ticket != ticket) continue;
    phone.ticket.clear();
    return number;
  }
  return 0;
}

void RelayCore::remove_phone(uint32_t phone) {
  phones_.erase(phone);
}

std::vector<uint32_t> RelayCore::late_phones(double now) const {
  std::vector<uint32_t> late;
  for (const auto& [number, phone] : phones_) {
    if (!phone.ticket.empty() && now - phone.came > limits_.ticket_timeout) late.push_back(number);
  }
  return late;
}

}  // namespace nao::relay
