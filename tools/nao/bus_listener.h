#pragma once

#include <string>

#include "tools/nao/channel_owners.h"

namespace nao {

/** Address of a multicast bus. */
struct BusAddress {
  std::string group = "239.255.76.67";
  int port = 7667;
};

/** Reads udpm://GROUP:PORT?options; omitted parts have LCM's defaults.
 * @throws ConfigError  The bus is of another kind, or the port is invalid. */
BusAddress parse_bus_address(const std::string& url);

/** Receives the datagrams of a bus with their senders, of which LCM does not tell. */
class BusListener {
 public:
  /** @throws BusError  The group cannot be joined. */
  explicit BusListener(const BusAddress& address);
  ~BusListener();
  BusListener(const BusListener&) = delete;
  BusListener& operator=(const BusListener&) = delete;

  int descriptor() const { return descriptor_; }

  /** Notes all datagrams that have arrived, without waiting. */
  void read(ChannelOwners& owners);

 private:
  int descriptor_;
};

}  // namespace nao
