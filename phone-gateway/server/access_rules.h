#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nao {

/** Which web requests the gateway answers, judged by the headers that a page from elsewhere cannot
 * choose. Keeps pages of other sites, and names that were pointed at this host to deceive a browser
 * (DNS rebinding), away from the robot. */
class AccessRules {
 public:
  /** @param host_names  Names that this host is known by, beside localhost and every IP address.
   *  @param origins  Other sites whose pages may connect, such as "http://localhost:5173". */
  AccessRules(std::vector<std::string> host_names, std::vector<std::string> origins)
      : host_names_(std::move(host_names)), origins_(std::move(origins)) {}

  /** Whether a Host header ("192.168.1.5:8080") names this host. An IP address always does: a name
   * that an attacker owns is what rebinding needs. */
  bool is_known_host(std::string_view host_header) const;

  /** Whether a WebSocket with this Origin may be opened: exactly the site that the gateway serves.
   * An empty one is no browser's, and passes. */
  bool is_known_origin(std::string_view origin, std::string_view host_header, bool is_secure) const;

 private:
  std::vector<std::string> host_names_;
  std::vector<std::string> origins_;
};

}  // namespace nao
