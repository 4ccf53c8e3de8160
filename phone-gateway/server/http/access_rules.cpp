#include "phone-gateway/server/http/access_rules.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>

namespace nao::gateway {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool is_ip_address(const std::string& host) {
  in_addr v4{};
  in6_addr v6{};
  return inet_pton(AF_INET, host.c_str(), &v4) == 1 || inet_pton(AF_INET6, host.c_str(), &v6) == 1;
}

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/** The host of "name:8080" or "[::1]:8080"; empty if the header has another form. Only an IPv6
 * address may have brackets. */
std::string host_without_port(std::string_view header) {
  if (!header.empty() && header.front() == '[') {
    const size_t end = header.find(']');
    if (end == std::string_view::npos) return "";
    const std::string_view rest = header.substr(end + 1);
    const bool has_good_rest = rest.empty() || (rest.front() == ':' && is_port(rest.substr(1)));
    const std::string_view address = header.substr(1, end - 1);
    const bool is_v6 = address.find(':') != std::string_view::npos;
    return has_good_rest && is_v6 ? std::string(address) : "";
  }
  const size_t colon = header.find(':');
  if (colon == std::string_view::npos) return std::string(header);
  return is_port(header.substr(colon + 1)) ? std::string(header.substr(0, colon)) : "";
}

}  // namespace

// Against DNS rebinding: a page of another site may make a browser send requests here under that
// site's name. Addresses are no names, and cannot be rebound.
bool AccessRules::is_known_host(std::string_view host_header) const {
  const std::string host = lower_case(host_without_port(host_header));
  if (host.empty()) return false;
  if (host == "localhost" || is_ip_address(host)) return true;
  return std::any_of(host_names_.begin(), host_names_.end(),
                     [&](const std::string& name) { return host == lower_case(name); });
}

// Against pages of other sites that open a WebSocket: browsers always send the Origin (RFC 6455,
// 10.2). Clients that are no browsers send none.
bool AccessRules::is_known_origin(std::string_view origin, std::string_view host_header,
                                  bool is_secure) const {
  if (origin.empty()) return true;
  const std::string own = (is_secure ? "https://" : "http://") + lower_case(host_header);
  return lower_case(origin) == own ||
         std::find(origins_.begin(), origins_.end(), origin) != origins_.end();
}

}  // namespace nao::gateway
