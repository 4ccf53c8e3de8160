#pragma once

#include <string>
#include <vector>

#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/network/network.h"

namespace nao::gateway {

/** Options of nao-phone-gateway. */
struct GatewayOptions {
  NetworkOptions network;
  /** The robots, see parse_robot_options(). */
  std::vector<std::string> robots = {"NAO"};
  /** Folder of robots/ that describes the robots without a model of their own. */
  std::string model = "nao";
  /** Scene in which they are, of scenes/ in the data folder. */
  std::string scene = "soccer";
  /** Offer the overview of a simulated world as a camera of every robot. */
  bool has_overview = false;
  /** Serve a phone by Bluetooth, under the first robot's name. */
  bool has_bluetooth = false;
  /** Pairing token; empty: a new one at each start. */
  std::string token;
  /** File of the token if `token` is empty, created if it does not exist; empty: none. */
  std::string token_file;
  /** Names of this host that browsers may use, in addition to its own name, localhost and IP
   * addresses. */
  std::vector<std::string> host_names;
  /** Other sites whose pages may connect: "http://localhost:5173". */
  std::vector<std::string> origins;
  /** File of the audit log, in addition to the program's log; empty: none. */
  std::string audit_file;
  /** Serve https in addition to http, on the same port. */
  bool uses_tls = false;
  /** Folder of the gateway's own certificate; empty: state_path(). Ignored if `network` has a
   * certificate. */
  std::string tls_folder;
  /** Print the address for phones as a QR code. */
  bool prints_qr = false;
  /** Print the addresses for phones, and end. */
  bool prints_addresses = false;
  /** File for the QR code, PNG; empty: none. */
  std::string qr_file;
  /** Announce the gateway in the local network. */
  bool announces = true;
  /** Host name, without ".local", that leads to the announced gateway; empty: none. */
  std::string mdns_name = "nao";
  /** Settings of an exhibition; empty: none. */
  std::string exhibition_file;
  /** Files of the exhibition: its state, the operator's secret, the report; empty: none. */
  std::string exhibition_state_file;
  std::string operator_secret_file;
  std::string exhibition_report_file;
  GatewayLimits limits;
};

}  // namespace nao::gateway
