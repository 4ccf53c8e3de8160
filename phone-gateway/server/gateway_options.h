#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "phone-gateway/server/gateway_limits.h"
#include "phone-gateway/server/network.h"

namespace nao {

/** What nao-phone-gateway can be told on its command line. */
struct GatewayOptions {
  NetworkOptions network;
  /** Folder of robots/ that describes the robot. */
  std::string model = "nao";
  /** What phones must say to connect; empty: a new one at each start. */
  std::string token;
  /** Names of this host that browsers may use, beside its own name, localhost and IP addresses. */
  std::vector<std::string> host_names;
  /** Other sites whose pages may connect: "http://localhost:5173". */
  std::vector<std::string> origins;
  /** File for the audit log beside the log; empty: none. */
  std::string audit_file;
  /** Serve https beside http, on the same port. */
  bool uses_tls = false;
  /** Folder of the gateway's own certificate; empty: state_folder(). Ignored if a certificate is
   * named in `network`. */
  std::string tls_folder;
  /** Print the address for phones as a QR code. */
  bool prints_qr = false;
  /** File to write it to, PNG; empty: none. */
  std::string qr_file;
  GatewayLimits limits;
};

}  // namespace nao
