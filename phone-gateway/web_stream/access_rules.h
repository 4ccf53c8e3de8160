#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace nao {

/** Decides which HTTP requests are answered, by the headers that a page of another site cannot set:
 * Host and Origin. Protects against cross-site WebSockets and DNS rebinding. */
class AccessRules {
 public:
  using Domains = std::function<std::vector<std::string>()>;

  /** @param host_names  Names of this host, in addition to localhost and IP addresses.
   * @param origins     Other sites whose pages may connect, such as "http://localhost:5173".
   * @param domains     Domains in which the network names this host, in addition to those that
   *   routers use; asked at every name that is not known without them. */
  AccessRules(std::vector<std::string> host_names, std::vector<std::string> origins,
              Domains domains = {});

  /** Whether a Host header ("192.168.1.5:8080") names this host.
   *
   * DNS rebinding needs a name in a domain of the attacker. So are accepted: every IP address;
   * localhost and *.localhost, which never leave this computer (RFC 6761, 6.3); the host's names
   * alone; and the host's names in a domain in which no attacker gets a name: the suffixes of home
   * routers and private networks (RFC 6762, appendix G; RFC 8375; fritz.box, which is AVM's), and
   * `domains`. The host's name in any domain would not do: it is not a secret, and
   * HOST.evil.example can be made. A dot at the end changes nothing (RFC 1034, 3.1). */
  bool is_known_host(std::string_view host_header) const;

  /** Names that is_known_host() accepts, for a certificate: the host's names, those without a
   * domain also in every domain, and localhost. */
  std::vector<std::string> all_host_names() const;

  /** Whether a WebSocket with this Origin may be opened: that of the server's own pages, or an
   * allowed one. Clients that are not browsers send none and are accepted. */
  bool is_known_origin(std::string_view origin, std::string_view host_header, bool is_secure) const;

 private:
  bool is_own_name(std::string_view host) const;

  std::vector<std::string> host_names_;
  std::vector<std::string> origins_;
  Domains domains_;
};

/** Whether pages of this origin come from this computer: "http://localhost:8000",
 * "https://127.0.0.1". */
bool is_origin_on_this_computer(std::string_view origin);

}  // namespace nao
