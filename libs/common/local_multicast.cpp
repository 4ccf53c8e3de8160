#include "common/local_multicast.h"

#include <arpa/inet.h>
#include <dlfcn.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <cstdlib>

namespace nao {
namespace {

std::atomic<bool> is_kept_local = false;

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int set_option(int descriptor, int level, int name, const void* value, socklen_t size) {
  static auto* const function = next<decltype(::setsockopt)>("setsockopt");
  return function(descriptor, level, name, value, size);
}

ip_mreqn loopback_of(in_addr group) {
  ip_mreqn request{};
  request.imr_multiaddr = group;
  request.imr_address.s_addr = htonl(INADDR_LOOPBACK);
  request.imr_ifindex = static_cast<int>(if_nametoindex("lo"));
  return request;
}

void send_by_loopback(int descriptor) {
  const ip_mreqn request = loopback_of({});
  (void)set_option(descriptor, IPPROTO_IP, IP_MULTICAST_IF, &request, sizeof request);
}

}  // namespace

bool is_local_bus(const std::string& lcm_url) {
  const size_t ttl = lcm_url.find("ttl=");
  return lcm_url.starts_with("udpm://") &&
         (ttl == std::string::npos || std::atoi(lcm_url.c_str() + ttl + 4) == 0);
}

void keep_multicast_local() {
  is_kept_local = true;
}

}  // namespace nao

// LCM tries a connection before anything else, which fails without a route.
extern "C" __attribute__((visibility("default"))) int connect(int descriptor,
                                                              const sockaddr* address,
                                                              socklen_t size) {
  static auto* const function = nao::next<decltype(::connect)>("connect");
  if (nao::is_kept_local && address != nullptr && address->sa_family == AF_INET &&
      IN_MULTICAST(ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr))) {
    nao::send_by_loopback(descriptor);
  }
  return function(descriptor, address, size);
}

// LCM sets the time to live of the socket that sends, and joins the group with both of its sockets.
extern "C" __attribute__((visibility("default"))) int setsockopt(int descriptor, int level,
                                                                 int name, const void* value,
                                                                 socklen_t size) noexcept {
  if (!nao::is_kept_local || level != IPPROTO_IP) {
    return nao::set_option(descriptor, level, name, value, size);
  }
  if (name == IP_MULTICAST_TTL) nao::send_by_loopback(descriptor);
  bool is_member = false;
  if (name == IP_ADD_MEMBERSHIP && size >= sizeof(ip_mreq)) {
    const ip_mreqn request = nao::loopback_of(static_cast<const ip_mreq*>(value)->imr_multiaddr);
    is_member = nao::set_option(descriptor, level, name, &request, sizeof request) == 0;
  }
  // The interface of the route as well, for programs that send there; there may be none, or the
  // route may be by the loopback interface.
  const int result = nao::set_option(descriptor, level, name, value, size);
  return is_member ? 0 : result;
}
