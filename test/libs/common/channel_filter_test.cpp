#include "common/channel_filter.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <naolcm/stop_command_t.hpp>
#include <string>

#include "common/bus.h"

namespace nao {
namespace {

/** A UDP socket on loopback with a filter, which it sends to itself. */
class FilteredSocket {
 public:
  explicit FilteredSocket(const std::vector<std::string>& channels)
      : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address_), size), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address_), &size), 0);
    std::vector<sock_filter> code = make_channel_filter(channels);
    const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
    EXPECT_EQ(setsockopt(socket_, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program), 0);
  }
  ~FilteredSocket() { close(socket_); }
  FilteredSocket(const FilteredSocket&) = delete;
  FilteredSocket& operator=(const FilteredSocket&) = delete;

  bool passes(const std::string& datagram) const {
    EXPECT_EQ(sendto(socket_, datagram.data(), datagram.size(), 0,
                     reinterpret_cast<const sockaddr*>(&address_), sizeof address_),
              static_cast<ssize_t>(datagram.size()));
    char received[256];
    return recv(socket_, received, sizeof received, 0) > 0;
  }

 private:
  int socket_;
  sockaddr_in address_{};
};

/** A message in one datagram, without content but for the type's eight bytes. */
std::string message_on(const std::string& channel) {
  return std::string("LC02") + std::string(4, '\7') + channel + std::string(1, '\0') + "12345678";
}

TEST(ChannelFilter, PassesItsChannelsOnly) {
  const std::vector<std::string> channels{"A",    "AB",    "NAO_JOINT_COMMAND",
                                          "ABCD", "ABCDE", "WORLD_TRUTH"};
  const FilteredSocket socket(channels);
  for (const std::string& channel : channels) EXPECT_TRUE(socket.passes(message_on(channel)));
  for (const std::string channel :
       {"", "B", "ABC", "ABCDEF", "NAO_JOINT_COMMANDS", "NAO_JOINT_COMMAN", "NAO2_JOINT_COMMAND",
        "WORLD_TRUTI", "WORLD", "A very long channel which nobody has subscribed to"}) {
    EXPECT_FALSE(socket.passes(message_on(channel))) << channel;
  }
}

TEST(ChannelFilter, PassesFragmentsAndWhatIsNoMessage) {
  const FilteredSocket socket({"A"});
  EXPECT_TRUE(socket.passes("LC03" + std::string(100, 'x')));
  EXPECT_TRUE(socket.passes("hello"));
}

TEST(ChannelFilter, WithoutChannelsPassesNoMessage) {
  const FilteredSocket socket({});
  EXPECT_FALSE(socket.passes(message_on("A")));
}

TEST(ChannelFilter, TooManyChannelsAreNotFiltered) {
  EXPECT_TRUE(make_channel_filter(std::vector<std::string>(500, std::string(40, 'x'))).empty());
}

/** What the kernel dropped of this process's receiving sockets at a port: the last column of
 * /proc/net/udp. */
long num_kernel_drops(const std::string& port_in_hex) {
  std::FILE* file = std::fopen("/proc/net/udp", "r");
  char line[512];
  long sum = 0;
  while (std::fgets(line, sizeof line, file) != nullptr) {
    const std::string text(line);
    if (text.find(":" + port_in_hex + " ") == std::string::npos) continue;
    sum += std::stol(text.substr(text.find_last_of(' ', text.find_last_not_of(" \n"))));
  }
  std::fclose(file);
  return sum;
}

TEST(ChannelFilter, ABusIsNotWokenByOtherChannels) {
  // 7863 is 1EB7.
  const std::string url = "udpm://239.255.76.67:7863?ttl=0";
  Bus receiver(url);
  Bus sender(url);
  int num_received = 0;
  const auto count = [&](const naolcm::stop_command_t& /*message*/) { ++num_received; };
  receiver.subscribe<naolcm::stop_command_t>("FIRST", Bus::Queue::kAll, count);
  receiver.subscribe<naolcm::stop_command_t>("SECOND", Bus::Queue::kAll, count);
  const long before = num_kernel_drops("1EB7");
  for (const char* channel : {"OTHER", "FIRST", "OTHER", "SECOND", "FIRSTS", "LAST"}) {
    sender.publish(channel, naolcm::stop_command_t());
  }
  while (num_received < 2) ASSERT_TRUE(receiver.handle_for(2));
  // LCM's own socket drops all of them.
  EXPECT_EQ(num_kernel_drops("1EB7") - before, 4 + 6);
  receiver.set_awake("FIRST", false);
  sender.publish("FIRST", naolcm::stop_command_t());
  receiver.set_awake("FIRST", true);
  sender.publish("FIRST", naolcm::stop_command_t());
  while (num_received < 3) ASSERT_TRUE(receiver.handle_for(2));
  EXPECT_EQ(num_kernel_drops("1EB7") - before, 5 + 8);
  // A pattern lets everything in.
  int num_raw = 0;
  receiver.subscribe_raw(".*", [&](const RawMessage&) { ++num_raw; });
  sender.publish("OTHER", naolcm::stop_command_t());
  while (num_raw < 1) ASSERT_TRUE(receiver.handle_for(2));
}

}  // namespace
}  // namespace nao
