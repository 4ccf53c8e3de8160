#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nao {

/** A gateway in the local network, as it announces itself. */
struct GatewayService {
  /** Name of the service, unique in the network: "NAO on lab-3". */
  std::string name;
  std::string robot;
  std::string model;
  /** Host name: "lab-3.local". */
  std::string host;
  /** IPv4. */
  std::string address;
  uint16_t http_port = 0;
  uint16_t tcp_port = 0;
  /** It also serves https. */
  bool uses_tls = false;
};

/** What a gateway announces. */
struct Announcement {
  GatewayService service;
  /** Host name without ".local" that shall lead to this host, too: "nao". Where another host has
   * it, "nao-2" to "nao-9" are tried. Empty: none. */
  std::string alias;
  /** IPv4 addresses for the alias. */
  std::vector<std::string> addresses;
};

/** Announces a gateway in the local network and finds others: multicast DNS service discovery
 * (RFC 6762, RFC 6763) by avahi-daemon, over its D-Bus interface. Service type: _nao-remote._tcp.
 *
 * avahi-daemon is optional and may come and go; while it is not there, nothing is announced and
 * nothing is found. No call blocks. */
class ServiceDiscovery {
 public:
  /** Names that an alias may end up with, ".local" included. */
  static std::vector<std::string> alias_names(const std::string& alias);

  /** @param announcement  None: finds only. */
  explicit ServiceDiscovery(std::optional<Announcement> announcement);
  ~ServiceDiscovery();
  ServiceDiscovery(const ServiceDiscovery&) = delete;
  ServiceDiscovery& operator=(const ServiceDiscovery&) = delete;

  /** To be called several times a second. @param now  s, monotonic. */
  void step(double now);

  /** Gateways but the announced one, by name. */
  std::vector<GatewayService> found() const;
  /** Name under which the gateway is announced; empty: it is not. */
  std::string announced_name() const;
  /** "nao.local" once the network has accepted it; empty before. */
  std::string alias() const;
  /** Why there is no discovery now; empty while there is. */
  std::string problem() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nao
