#pragma once

#include <linux/filter.h>

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

}  // namespace nao
