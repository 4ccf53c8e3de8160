#include "tools/nao/channel_owners.h"

#include <algorithm>
#include <naolcm/daemon_status_t.hpp>
#include <string_view>

#include "common/channels.h"

namespace nao {
namespace {

/** "LC02", a message in one datagram; a sequence number of 4 bytes follows, then the channel. */
constexpr std::string_view kWholeMessage = "LC02";
constexpr size_t kChannelOffset = 8;
// A process that is restarted changes the sender once, and its last messages may be late.
constexpr int kMinChanges = 3;

/** Whether a channel has one publisher. */
bool has_one_owner(const std::string& channel) {
  return channel.ends_with("_STATE") || channel.ends_with("_JOINT_COMMAND") ||
         channel == kWorldTruthChannel;
}

}  // namespace

void ChannelOwners::note(const std::string& sender, std::span<const uint8_t> datagram) {
  const std::string_view text(reinterpret_cast<const char*>(datagram.data()), datagram.size());
  const size_t end = text.find('\0', kChannelOffset);
  if (!text.starts_with(kWholeMessage) || end == std::string_view::npos) return;
  const std::string channel(text.substr(kChannelOffset, end - kChannelOffset));
  if (channel == kDaemonStatusChannel) {
    naolcm::daemon_status_t status;
    const std::span<const uint8_t> message = datagram.subspan(end + 1);
    try {
      if (status.decode(message.data(), 0, static_cast<int>(message.size())) < 0) return;
    } catch (const std::exception&) {
      // LCM's decoder throws where a text has the length 0.
      return;
    }
    names_[sender] = status.program + " of host " + status.host + " (process " +
                     std::to_string(status.process_id) + ")";
  } else if (has_one_owner(channel)) {
    Channel& seen = channels_[channel];
    if (std::find(seen.senders.begin(), seen.senders.end(), sender) == seen.senders.end()) {
      seen.senders.push_back(sender);
    }
    seen.num_changes += seen.last_sender != sender ? 1 : 0;
    seen.last_sender = sender;
  }
}

std::vector<std::string> ChannelOwners::owners_of(const std::string& channel) const {
  const auto found = channels_.find(channel);
  if (found == channels_.end()) return {};
  std::vector<std::string> owners = found->second.senders;
  for (std::string& owner : owners) {
    if (const auto name = names_.find(owner); name != names_.end()) owner = name->second;
  }
  return owners;
}

std::vector<std::string> ChannelOwners::find_shared() const {
  std::vector<std::string> shared;
  for (const auto& [name, channel] : channels_) {
    if (channel.senders.size() > 1 && channel.num_changes > kMinChanges) shared.push_back(name);
  }
  return shared;
}

}  // namespace nao
