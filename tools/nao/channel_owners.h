#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace nao {

/** Finds channels on which two programs publish, of channels that have one publisher and whose
 * messages begin with the robot's time: LCM does not tell who has sent a message. */
class ChannelOwners {
 public:
  /** @param message  Encoded, of a channel that matches kOwnedChannels. */
  void note(const std::string& channel, const uint8_t* message, int num_bytes);
  void note(const std::string& channel, int64_t utime);

  bool is_published(const std::string& channel) const { return seen_.contains(channel); }
  /** Channels with two publishers: the robot's time goes back again and again, as that of two
   * robots, or most times come twice, as of two programs that answer one robot. */
  std::vector<std::string> find_shared() const;

 private:
  struct Seen {
    int64_t last = 0;
    int num_messages = 0;
    int num_back = 0;
    int num_equal = 0;
  };
  std::map<std::string, Seen> seen_;
};

/** Regular expression of those channels. */
inline constexpr const char* kOwnedChannels =
    ".*_(SENSOR|ROBOT|MOTION|PLAY|VISION)_STATE|.*_JOINT_COMMAND|WORLD_TRUTH|MATCH_STATE";

}  // namespace nao
