#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nao::gateway {

/** Where the app is served, and the token that admits a phone. */
struct PhoneAddress {
  /** Address that the gateway listens on; "0.0.0.0" and "::": all. */
  std::string bind;
  uint16_t port = 0;
  bool uses_tls = false;
  std::string token;
};

/** The addresses to open in a phone's browser, such as "http://192.168.1.5:8080/#token=...". The
 * part after # is not sent in requests, so that no log of a proxy has the token.
 * @param own_addresses  Addresses of this host, for a gateway that listens on all; if it has none,
 * the address is 127.0.0.1. */
std::vector<std::string> phone_urls(const PhoneAddress& at,
                                    const std::vector<std::string>& own_addresses);

}  // namespace nao::gateway
