#pragma once

#include <linux/filter.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nao {

/** Program for the kernel's packet filter (classic BPF, SO_ATTACH_FILTER) on a UDP socket that
 * receives LCM messages: passes those on the given channels, and all that are sent in fragments,
 * which say in their first datagram only on what channel they are.
 *
 * LCM filters, too, but in the process: without the kernel's filter every process on a host wakes
 * for every message of every robot. Layout of the datagrams: LCM's "UDP Multicast Protocol
 * Description". Empty if the program would exceed the kernel's limit. */
std::vector<sock_filter> make_channel_filter(const std::vector<std::string>& channels);

/** Keeps the filter of one bus. */
class ChannelFilter {
 public:
  /** Makes LCM open its receiving socket, if it has none yet, and remembers it.
   * @param open  Calls LCM. Other buses (of a memory, of a file) have no socket and no filter. */
  void open_socket(const std::function<void()>& open);

  /** Lets messages on this channel pass. */
  void add(const std::string& channel);
  /** Ends add(). */
  void remove(const std::string& channel);
  /** Lets all pass, for good. */
  void pass_all();

 private:
  void attach();

  bool is_open_ = false;
  bool passes_all_ = false;
  std::optional<int> socket_;
  std::vector<std::string> channels_;
};

}  // namespace nao
