#include "tools/nao/bus_listener.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "common/error.h"

namespace nao {
namespace {

// The largest datagram of UDP.
constexpr size_t kMaxDatagram = 65535;

}  // namespace

BusAddress parse_bus_address(const std::string& url) {
  const std::string scheme = "udpm://";
  if (!url.starts_with(scheme)) {
    throw ConfigError("only " + scheme + " buses can be checked, not " + url);
  }
  const std::string place = url.substr(scheme.size(), url.find('?') - scheme.size());
  const size_t colon = place.find(':');
  BusAddress address;
  if (colon != 0 && !place.empty()) address.group = place.substr(0, colon);
  if (colon != std::string::npos) {
    const std::string port = place.substr(colon + 1);
    const char* end = port.data() + port.size();
    if (const auto [rest, error] = std::from_chars(port.data(), end, address.port);
        rest != end || error != std::errc() || address.port < 1 || address.port > 65535) {
      throw ConfigError("'" + port + "' in " + url + " is not a port from 1 to 65535");
    }
  }
  return address;
}

BusListener::BusListener(const BusAddress& address)
    : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_port = htons(static_cast<uint16_t>(address.port));
  ip_mreq request{};
  const int yes = 1;
  if (inet_pton(AF_INET, address.group.c_str(), &request.imr_multiaddr) != 1 ||
      setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      bind(descriptor_, reinterpret_cast<sockaddr*>(&local), sizeof local) != 0 ||
      setsockopt(descriptor_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) != 0) {
    const std::string why = std::strerror(errno);
    close(descriptor_);
    throw BusError("cannot listen to " + address.group + ": " + why + "; try: nao bus");
  }
}

BusListener::~BusListener() {
  close(descriptor_);
}

void BusListener::read(ChannelOwners& owners) {
  std::array<uint8_t, kMaxDatagram> datagram;
  sockaddr_in sender{};
  while (true) {
    socklen_t size = sizeof sender;
    const ssize_t num_bytes = recvfrom(descriptor_, datagram.data(), datagram.size(), 0,
                                       reinterpret_cast<sockaddr*>(&sender), &size);
    if (num_bytes < 0) return;
    std::array<char, INET_ADDRSTRLEN> host{};
    inet_ntop(AF_INET, &sender.sin_addr, host.data(), host.size());
    owners.note(std::string(host.data()) + ":" + std::to_string(ntohs(sender.sin_port)),
                {datagram.data(), static_cast<size_t>(num_bytes)});
  }
}

}  // namespace nao
