// nao-phone-gateway: lets phones drive the robot. See README.md.
#include <google/protobuf/stubs/logging.h>
#include <fstream>
#include <iostream>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/scheduling.h"
#include "common/wall_clock.h"
#include "phone-gateway/server/bus/gateway_daemon.h"
#include "phone-gateway/server/bus/robot_description.h"
#include "phone-gateway/server/core/secret.h"
#include "phone-gateway/server/gateway_options.h"
#include "phone-gateway/server/http/web_pages.h"
#include "phone-gateway/server/network/network.h"
#include "phone-gateway/server/pairing/certificate.h"
#include "phone-gateway/server/pairing/own_addresses.h"
#include "phone-gateway/server/pairing/phone_urls.h"
#include "phone-gateway/server/pairing/qr_code.h"
#include "phone-gateway/server/pairing/token_file.h"

namespace nao::gateway {
namespace {

/** Period of repetitions and timeouts, s; a fifth of the shortest one, 0.1 s. */
constexpr double kStepPeriod = 0.02;
/** Period of DAEMON_STATUS, s. */
constexpr double kStatusPeriod = 1.0;
/** Time for sending the last messages, s. Chosen: one tenth of the 2 s in which a program must
 * stop. */
constexpr double kDrainTime = 0.2;
/** Pixels per module of the QR code in a file. Chosen: about 300 pixels in all. */
constexpr int kQrScale = 8;

void add_gateway_options(CommandLine& app, GatewayOptions& options) {
  NetworkOptions& network = options.network;
  app.add_option("--http-port", network.http_port, "Port of the app and of WebSockets; 0: any free")
      ->show_default();
  app.add_option("--tcp-port", network.tcp_port, "Port of raw TCP clients; 0: any free")
      ->show_default();
  app.add_option("--bind", network.bind, "Address to listen on; 0.0.0.0: all")->show_default();
  app.add_option("--model", options.model, "Folder of robots/ that describes the robot")
      ->show_default();
  app.add_option("--token", options.token,
                 "Pairing token that clients must send; default: a new one at each start");
  app.add_option("--token-file", options.token_file,
                 "File of the pairing token; created with a new one if it does not exist");
  app.add_option("--host-name", options.host_names,
                 "Another name of this host that browsers may use (repeatable)");
  app.add_option(
      "--allow-origin", options.origins,
      "Another site whose pages may connect, such as http://localhost:5173 (repeatable)");
  app.add_flag(
      "--tls", options.uses_tls,
      "Serve https in addition to http, on the same port: phones give tilt sensors to secure "
      "pages only");
  app.add_option("--tls-dir", options.tls_folder,
                 "Folder of the gateway's own certificate; default: ~/.local/state/nao-remote");
  app.add_option("--key", network.key_file, "Key of --certificate, PEM")->existing_file();
  app.add_option("--certificate", network.certificate_file,
                 "Certificate chain, PEM, instead of the gateway's own certificate")
      ->needs("--tls")
      ->needs("--key")
      ->existing_file();
  app.add_option("--audit-log", options.audit_file,
                 "File to which connections, drivers and refusals are appended as JSON lines");
  app.add_flag("--print-qr", options.prints_qr, "Print the address for phones as a QR code");
  app.add_flag("--print-addresses", options.prints_addresses,
               "Print the addresses for phones that these options give, one a line, and end");
  app.add_option("--qr-png", options.qr_file, "Write the QR code to this file, PNG");
}

AccessRules make_access_rules(const GatewayOptions& options) {
  std::vector<std::string> names = options.host_names;
  const std::string own_name = own_host_name();
  names.push_back(own_name);
  names.push_back(own_name + ".local");
  return AccessRules(names, options.origins);
}

/** Ensures that there is a certificate if https is requested. */
void prepare_tls(GatewayOptions& options) {
  if (!options.uses_tls) return;
  NetworkOptions& network = options.network;
  if (network.certificate_file.empty()) {
    CertificateNames names;
    names.host_names = {own_host_name(), own_host_name() + ".local", "localhost"};
    names.host_names.insert(names.host_names.end(), options.host_names.begin(),
                            options.host_names.end());
    names.addresses = own_addresses();
    names.addresses.push_back("127.0.0.1");
    const CertificateFiles files = own_certificate(
        options.tls_folder.empty() ? state_folder() : std::filesystem::path(options.tls_folder),
        names);
    network.certificate_file = files.certificate;
    network.key_file = files.key;
  }
  logger::info("https with {}, SHA-256 {}", network.certificate_file,
               certificate_fingerprint(network.certificate_file));
}

/** The addresses to open in a phone's browser. */
std::vector<std::string> addresses_for_phones(const GatewayOptions& options, uint16_t port) {
  return phone_urls({options.network.bind, port, options.uses_tls, options.token}, own_addresses());
}

/** Prints the addresses, one a line; if requested, then an empty line and the first as a QR code.
 */
void print_addresses(const GatewayOptions& options) {
  const std::vector<std::string> urls = addresses_for_phones(options, options.network.http_port);
  for (const std::string& url : urls) std::cout << url << "\n";
  if (options.prints_qr) std::cout << "\n" << draw_on_terminal(make_qr_code(urls.front()));
  std::cout.flush();
}

/** Prints and writes the QR code of an address, as the options request. */
void show_qr_code(const GatewayOptions& options, const std::string& url) {
  if (options.prints_qr) {
    std::cout << draw_on_terminal(make_qr_code(url)) << url << std::endl;
  }
  if (options.qr_file.empty()) return;
  std::ofstream file(options.qr_file, std::ios::binary);
  file << draw_as_png(make_qr_code(url), kQrScale);
  if (!file.flush()) throw Error("cannot write " + options.qr_file);
}

void run_gateway(const CommonOptions& common, GatewayOptions options) {
  // The library prints a line for every message that it cannot parse: any host could fill the log.
  google::protobuf::SetLogHandler(nullptr);
  if (options.token.empty()) {
    options.token = options.token_file.empty() ? make_token() : token_from_file(options.token_file);
  }
  if (options.prints_addresses) {
    print_addresses(options);
    return;
  }
  prepare_tls(options);
  const std::filesystem::path folder = data_path() / "robots" / options.model;
  if (request_realtime_scheduling(RealtimePriority::kServing))
    logger::info("uses real-time scheduling (SCHED_RR)");
  Bus bus(common.lcm_url);
  GatewayDaemon daemon(bus, describe_robot(common.robot, RobotModel::load(folder)), options.limits,
                       options.token, options.audit_file);
  WebPages pages(data_path());
  Network network(options.network, make_access_rules(options), daemon.core(), pages);

  network.on_readable(bus.descriptor(), [&bus] { bus.handle(); });
  network.every(kStepPeriod, [&daemon] { daemon.step(monotonic_seconds()); });
  network.every(kStatusPeriod, [&daemon] { daemon.publish_status(monotonic_seconds()); });
  logger::info("version {}, bus {}, robot {} from {}", version(), common.lcm_url, common.robot,
               folder.string());
  logger::info("HTTP and WebSocket on {}:{}, TCP on {}:{}", options.network.bind,
               network.http_port(), options.network.bind, network.tcp_port());
  const std::vector<std::string> urls = addresses_for_phones(options, network.http_port());
  for (const std::string& url : urls) logger::info("phones: {}", url);
  show_qr_code(options, urls.front());
  pages.add_page("/metrics", {"text/plain; version=0.0.4", true, [&daemon, &network] {
                                return daemon.metrics_text(network.metrics());
                              }});
  pages.add_page("/qr.png", {"image/png", true, [url = urls.front()] {
                               return draw_as_png(make_qr_code(url), kQrScale);
                             }});
  daemon.publish_status(monotonic_seconds());

  const std::string reason = network.run();
  daemon.shut_down(monotonic_seconds());
  network.drain(kDrainTime);
  const NetworkCounters& counters = network.counters();
  logger::info("stopped: {}; {} connections, {} web requests, {} violations, {} messages dropped",
               reason, counters.num_accepted, counters.num_http_requests, counters.num_violations,
               bus.counters().num_dropped);
}

}  // namespace
}  // namespace nao::gateway

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Lets phones drive the robot: the app over HTTP, the protocol over WebSocket and TCP",
      "nao-phone-gateway");
  nao::CommonOptions common;
  nao::gateway::GatewayOptions options;
  nao::add_common_options(app, common);
  nao::gateway::add_gateway_options(app, options);
  return nao::run_program(app, common, argc, argv,
                          [&] { nao::gateway::run_gateway(common, std::move(options)); });
}
