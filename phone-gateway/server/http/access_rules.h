#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nao::gateway {

/** Decides which HTTP requests are answered, by the headers that a page of another site cannot set:
 * Host and Origin. Protects against cross-site WebSockets and DNS rebinding. */
class AccessRules {
 public:
  /** @param host_names  Names of this host, in addition to localhost and IP addresses.
   * @param origins     Other sites whose pages may connect, such as "http://localhost:5173". */
  AccessRules(std::vector<std::string> host_names, std::vector<std::string> origins)
      : host_names_(std::move(host_names)), origins_(std::move(origins)) {}

  /** Whether a Host header ("192.168.1.5:8080") names this host. Every IP address is accepted: DNS
   * rebinding needs a name that the attacker owns. */
  bool is_known_host(std::string_view host_header) const;

  /** Whether a WebSocket with this Origin may be opened: that of the gateway's own pages, or an
   * allowed one. Clients that are no browsers send none and are accepted. */
  bool is_known_origin(std::string_view origin, std::string_view host_header, bool is_secure) const;

 private:
  std::vector<std::string> host_names_;
  std::vector<std::string> origins_;
};

}  // namespace nao::gateway
