#include "phone-gateway/web_stream/access_rules.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace nao {
namespace {

/** Domains that home routers and private networks use; their sources are in the header. */
constexpr std::array<std::string_view, 11> kPrivateDomains = {
    "local", "localdomain", "lan",     "home",      "home.arpa",   "internal",
    "corp",  "intranet",    "private", "fritz.box", "speedport.ip"};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool is_ip_address(std::string_view host) {
  // An IPv6 address may name its interface: "fe80::1%eth0", in a URL "fe80::1%25eth0" (RFC 6874).
  const size_t zone = host.find('%');
  const std::string address(host.substr(0, zone));
  in_addr v4{};
  in6_addr v6{};
  return inet_pton(AF_INET6, address.c_str(), &v6) == 1 ||
         (zone == std::string_view::npos && inet_pton(AF_INET, address.c_str(), &v4) == 1);
}

bool is_localhost(std::string_view host) {
  return host == "localhost" || host.ends_with(".localhost");
}

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string_view without_last_dot(std::string_view name) {
  if (name.ends_with('.')) name.remove_suffix(1);
  return name;
}

/** The host of "name:8080" or "[::1]:8080", in lower case and without a dot at its end; empty if
 * the header has another form. Only an IPv6 address may have brackets. */
std::string host_without_port(std::string_view header) {
  if (!header.empty() && header.front() == '[') {
    const size_t end = header.find(']');
    if (end == std::string_view::npos) return "";
    const std::string_view rest = header.substr(end + 1);
    const bool has_good_rest = rest.empty() || (rest.front() == ':' && is_port(rest.substr(1)));
    const std::string_view address = header.substr(1, end - 1);
    const bool is_v6 = address.find(':') != std::string_view::npos;
    return has_good_rest && is_v6 ? lower_case(address) : "";
  }
  const size_t colon = header.find(':');
  if (colon != std::string_view::npos && !is_port(header.substr(colon + 1))) return "";
  return lower_case(without_last_dot(header.substr(0, colon)));
}

}  // namespace

AccessRules::AccessRules(std::vector<std::string> host_names, std::vector<std::string> origins,
                         Domains domains)
    : host_names_(std::move(host_names)),
      origins_(std::move(origins)),
      domains_(std::move(domains)) {
  for (std::string& name : host_names_) name = lower_case(without_last_dot(name));
}

bool AccessRules::is_own_name(std::string_view host) const {
  if (std::find(host_names_.begin(), host_names_.end(), host) != host_names_.end()) return true;
  const auto is_in = [&](std::string_view domain) {
    return std::any_of(host_names_.begin(), host_names_.end(), [&](const std::string& name) {
      return !name.empty() && !domain.empty() && host.size() == name.size() + 1 + domain.size() &&
             host.starts_with(name) && host[name.size()] == '.' && host.ends_with(domain);
    });
  };
  if (std::any_of(kPrivateDomains.begin(), kPrivateDomains.end(), is_in)) return true;
  if (!domains_) return false;
  const std::vector<std::string> domains = domains_();
  return std::any_of(domains.begin(), domains.end(), [&](const std::string& domain) {
    return is_in(lower_case(without_last_dot(domain)));
  });
}

std::vector<std::string> AccessRules::all_host_names() const {
  std::vector<std::string> domains(kPrivateDomains.begin(), kPrivateDomains.end());
  if (domains_) {
    for (const std::string& domain : domains_()) domains.push_back(domain);
  }
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const std::string& name : host_names_) {
    if (name.empty()) continue;
    add(name);
    if (name.find('.') != std::string::npos) continue;
    for (const std::string& domain : domains) {
      if (!domain.empty()) add(name + "." + lower_case(without_last_dot(domain)));
    }
  }
  add("localhost");
  return names;
}

bool AccessRules::is_known_host(std::string_view host_header) const {
  const std::string host = host_without_port(host_header);
  if (host.empty()) return false;
  return is_localhost(host) || is_ip_address(host) || is_own_name(host);
}

// Against pages of other sites that open a WebSocket: browsers always send the Origin (RFC 6455,
// 10.2). Clients that are not browsers send none.
bool AccessRules::is_known_origin(std::string_view origin, std::string_view host_header,
                                  bool is_secure) const {
  if (origin.empty()) return true;
  const std::string own = (is_secure ? "https://" : "http://") + lower_case(host_header);
  return lower_case(origin) == own ||
         std::find(origins_.begin(), origins_.end(), origin) != origins_.end();
}

bool is_origin_on_this_computer(std::string_view origin) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!origin.starts_with(scheme)) continue;
    const std::string host = host_without_port(origin.substr(scheme.size()));
    in_addr v4{};
    const bool is_loopback = inet_pton(AF_INET, host.c_str(), &v4) == 1
                                 ? ntohl(v4.s_addr) >> 24 == IN_LOOPBACKNET
                                 : host == "::1";
    return is_loopback || is_localhost(host);
  }
  return false;
}

}  // namespace nao
