#include "phone-gateway/server/pairing/phone_urls.h"

namespace nao::gateway {

std::vector<std::string> phone_urls(const PhoneAddress& at,
                                    const std::vector<std::string>& own_addresses) {
  std::vector<std::string> addresses = {at.bind};
  if (at.bind == "0.0.0.0" || at.bind == "::") {
    addresses = own_addresses;
    if (addresses.empty()) addresses = {"127.0.0.1"};
  }
  const std::string scheme = at.uses_tls ? "https://" : "http://";
  std::vector<std::string> urls;
  for (const std::string& address : addresses) {
    // RFC 3986, 3.2.2: an IPv6 address stands in brackets.
    const bool is_v6 = address.find(':') != std::string::npos;
    // The token stands in the fragment, which browsers do not send: it is in no server's log.
    urls.push_back(scheme + (is_v6 ? "[" + address + "]" : address) + ":" +
                   std::to_string(at.port) + "/#token=" + at.token);
  }
  return urls;
}

}  // namespace nao::gateway
