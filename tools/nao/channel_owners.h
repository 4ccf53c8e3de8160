#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace nao {

/** Finds who publishes on channels of which each has one publisher, and on which two do: by the
 * sender of each datagram, of which a process has one for each bus.
 *
 * Layout of the datagrams: LCM's "UDP Multicast Protocol Description". Messages in fragments, such
 * as images, are left out. */
class ChannelOwners {
 public:
  /** Begins anew; processes keep their names. */
  void forget_channels() { channels_.clear(); }

  /** @param sender  Address and port. */
  void note(const std::string& sender, std::span<const uint8_t> datagram);

  /** "nao-sim of host pc (process 12)" of each that publishes on the channel, or its address if it
   * publishes no status. */
  std::vector<std::string> owners_of(const std::string& channel) const;

  /** Channels on which several processes publish in turns, unlike one that was restarted. */
  std::vector<std::string> find_shared() const;

 private:
  struct Channel {
    std::vector<std::string> senders;
    std::string last_sender;
    int num_changes = 0;
  };
  std::map<std::string, Channel> channels_;
  /** Names of processes, by their senders. */
  std::map<std::string, std::string> names_;
};

}  // namespace nao
