// nao-phone-gateway: lets phones drive the robot. See README.md.
#include <google/protobuf/stubs/logging.h>
#include <iostream>
#include <optional>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/logger.h"
#include "common/output_file.h"
#include "common/program.h"
#include "common/robot_option.h"
#include "common/scheduling.h"
#include "common/wall_clock.h"
#include "phone-gateway/discovery/gateway_list.h"
#include "phone-gateway/discovery/service_discovery.h"
#include "phone-gateway/secure_channel/invitations.h"
#include "phone-gateway/server/bus/exhibition_files.h"
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
#include "phone-gateway/web_stream/asio_loop.h"
#include "phone-gateway/web_stream/own_host.h"

namespace nao::gateway {
namespace {

/** Period of repetitions and timeouts, s; a quarter of the shortest one, 0.1 s. With messages of a
 * robot, 100 a second, the second one of them causes a step, before that. */
constexpr double kStepPeriod = 0.025;
constexpr double kLeastStepPeriod = 0.015;
/** The same without a client, s. Chosen: a tenth of the timeouts of components. */
constexpr double kIdlePeriod = 0.1;
/** Period of DAEMON_STATUS, s. */
constexpr double kStatusPeriod = 1.0;
/** Period, s, of looking for messages of avahi-daemon. Chosen: the page shows changes at once for a
 * person. */
constexpr double kDiscoveryPeriod = 0.2;
/** Time for sending the last messages, s. Chosen: one tenth of the 2 s in which a program must
 * stop. */
constexpr double kDrainTime = 0.2;
/** Pixels per module of the QR code in a file. Chosen: about 300 pixels in all. */
constexpr int kQrScale = 8;

void add_gateway_options(CommandLine& app, GatewayOptions& options) {
  NetworkOptions& network = options.network;
  app.add_option("--http-port", network.http_port,
                 "Port of the app and of WebSockets; 0: any free");
  app.add_option("--tcp-port", network.tcp_port, "Port of raw TCP clients; 0: any free");
  app.add_option("--bind", network.bind, "Address to listen on; 0.0.0.0: all, also of IPv6");
  app.add_option("--tcp-congestion", network.congestion_control,
                 "TCP congestion control towards clients, such as bbr, where the system permits "
                 "it; default: the system's");
  add_robot_option(app, options.robots);
  app.add_option("--model", options.model,
                 "Folder of robots/ that describes the robots whose --robot names none");
  app.add_option("--scene", options.scene, "Scene whose field the app shows");
  app.add_flag("--overview", options.has_overview,
               "Offer clients the camera beside the field, which nao-head-camera has in a "
               "simulated world");
  app.add_option("--token", options.token,
                 "Pairing token that clients must send; default: a new one at each start");
  app.add_option("--token-file", options.token_file,
                 "File of the pairing token; created with a new one if it does not exist");
  app.add_option("--host-name", options.host_names,
                 "Another name of this host that browsers may use (repeatable)");
  app.add_flag("!--no-announce", options.announces,
               "Do not announce the gateway in the local network; by default avahi-daemon, if it "
               "runs, does so unless --bind is a loopback address");
  app.add_option("--mdns-name", options.mdns_name,
                 "Announce this host also as NAME.local, or NAME-2.local where that is taken; "
                 "empty: no name");
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
  app.add_option("--relay", network.relay,
                 "HOST[:PORT] of a nao-relay, over which invited phones connect from anywhere: "
                 "docs/anywhere.md");
  app.add_option("--relay-file", network.relay_file,
                 "File of the robot's key at --relay and of the invitations of nao invite; "
                 "default: ~/.local/state/nao-remote/relay.json");
  app.add_flag("--bluetooth", options.has_bluetooth,
               "Also serve one phone at a time by Bluetooth, with BlueZ: docs/app.md");
  app.add_option("--exhibition", options.exhibition_file,
                 "Visitors drive in turn, by the settings in this file: docs/exhibition.md")
      ->existing_file();
  app.add_option("--exhibition-state", options.exhibition_state_file,
                 "File with which the queue of --exhibition survives a restart");
  app.add_option("--exhibition-report", options.exhibition_report_file,
                 "File for the report of --exhibition: visitors, minutes, falls, stops, faults");
  app.add_option(
      "--operator-secret-file", options.operator_secret_file,
      "File of the secret of the page /operator of --exhibition; created with a new one if "
      "it does not exist");
  app.add_option("--audit-log", options.audit_file,
                 "File to which connections, drivers and refusals are appended as JSON lines");
  app.add_flag("--print-qr", options.prints_qr, "Print the address for phones as a QR code");
  app.add_flag("--print-addresses", options.prints_addresses,
               "Print the addresses for phones that these options give, one a line, and end");
  app.add_option("--qr-png", options.qr_file, "Write the QR code to this file, PNG");
}

AccessRules make_access_rules(const GatewayOptions& options) {
  std::vector<std::string> names = own_host_names();
  names.insert(names.end(), options.host_names.begin(), options.host_names.end());
  if (!options.mdns_name.empty()) {
    for (const std::string& name : ServiceDiscovery::alias_names(options.mdns_name)) {
      names.push_back(name);
    }
  }
  return AccessRules(names, options.origins, own_search_domains);
}

/** Ensures that there is a certificate if https is requested. */
void prepare_tls(GatewayOptions& options) {
  if (!options.uses_tls) return;
  NetworkOptions& network = options.network;
  if (network.certificate_file.empty()) {
    CertificateNames names;
    names.host_names = make_access_rules(options).all_host_names();
    names.addresses = own_addresses();
    names.addresses.push_back("127.0.0.1");
    const CertificateFiles files = own_certificate(
        options.tls_folder.empty() ? state_path() : std::filesystem::path(options.tls_folder),
        names);
    network.certificate_file = files.certificate;
    network.key_file = files.key;
  }
  logger::info("https with {}, SHA-256 {}", network.certificate_file,
               certificate_fingerprint(network.certificate_file));
}

/** Serves the scene in which the robots are: the app draws its lines, and drives without them. */
void add_scene_page(WebPages& pages, const std::string& scene) {
  const std::filesystem::path path = data_path() / "scenes" / (scene + ".yaml");
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (text.empty()) {
    logger::warn("cannot read {}: the app shows no field", path.string());
    return;
  }
  pages.add_page("/scene.yaml",
                 {"text/yaml; charset=utf-8", false, [text = std::move(text)] { return text; }});
}

/** The addresses to open in a phone's browser. */
std::vector<std::string> addresses_for_phones(const GatewayOptions& options, uint16_t port) {
  return phone_urls({options.network.bind, port, options.uses_tls, options.token}, own_addresses());
}

std::vector<naoremote::RobotDescription> describe_robots(const std::vector<RobotOption>& robots,
                                                         bool has_overview) {
  std::vector<naoremote::RobotDescription> descriptions;
  for (const RobotOption& robot : robots) {
    const std::filesystem::path folder = data_path() / "robots" / robot.model;
    logger::info("robot {} from {}", robot.name, folder.string());
    descriptions.push_back(describe_robot(robot.name, RobotModel::load(folder)));
    if (has_overview) add_overview(descriptions.back());
  }
  return descriptions;
}

/** Teams and numbers of the robots that have any. */
std::vector<PlayerLabel> label_players(const std::vector<RobotOption>& robots) {
  std::vector<PlayerLabel> players;
  for (const RobotOption& robot : robots) {
    if (!robot.team) continue;
    players.push_back(
        {robot.name, static_cast<uint32_t>(*robot.team), static_cast<uint32_t>(robot.number)});
  }
  return players;
}

/** What to announce; nothing if others cannot connect, or must not find it. */
std::optional<Announcement> make_announcement(const GatewayOptions& options,
                                              const std::vector<RobotOption>& robots,
                                              const Network& network) {
  const bool is_loopback = options.network.bind.starts_with("127.") ||
                           options.network.bind == "::1" || options.network.bind == "localhost";
  if (!options.announces || is_loopback) return std::nullopt;
  Announcement announcement;
  // A name has at most 63 bytes (RFC 6763, section 4.1.1): of several robots the first and a count.
  std::string name = robots.front().name;
  if (robots.size() > 1) name += " and " + std::to_string(robots.size() - 1) + " more";
  announcement.service.name = name + " on " + own_host_name();
  announcement.service.robot = robots.front().name;
  announcement.service.model = robots.front().model;
  announcement.service.http_port = network.http_port();
  announcement.service.tcp_port = network.tcp_port();
  announcement.service.uses_tls = options.uses_tls;
  // avahi-daemon itself announces the host's own name.
  if (options.mdns_name != own_host_name()) announcement.alias = options.mdns_name;
  announcement.addresses = own_addresses();
  return announcement;
}

/** @return Nothing without --exhibition. */
std::optional<ExhibitionSetup> make_exhibition(const GatewayOptions& options,
                                               const ExhibitionFiles& files) {
  if (options.exhibition_file.empty()) return std::nullopt;
  if (options.robots.size() > 1) throw ConfigError("--exhibition is for one robot, not several");
  return ExhibitionSetup{load_exhibition(options.exhibition_file, data_path()),
                         options.operator_secret_file.empty()
                             ? make_token()
                             : token_from_file(options.operator_secret_file),
                         files.read()};
}

/** Logs what has changed since the last call. */
class DiscoveryLog {
 public:
  void write(const ServiceDiscovery& discovery, uint16_t port) {
    if (note(problem_, discovery.problem()) && !problem_.empty()) {
      logger::info("not announced in the local network: {}", problem_);
    }
    if (note(name_, discovery.announced_name()) && !name_.empty()) {
      logger::info("announced in the local network as \"{}\"", name_);
    }
    if (note(alias_, discovery.alias()) && !alias_.empty()) {
      logger::info("phones in the local network: http://{}:{}", alias_, port);
    }
  }

 private:
  static bool note(std::string& last, const std::string& value) {
    const bool is_new = last != value;
    last = value;
    return is_new;
  }

  std::string problem_;
  std::string name_;
  std::string alias_;
};

/** Prints the addresses, one a line; if requested, then an empty line and the first as a QR code
 * with the pairing code below.
 */
void print_addresses(const GatewayOptions& options) {
  const std::vector<std::string> urls = addresses_for_phones(options, options.network.http_port);
  for (const std::string& url : urls) std::cout << url << "\n";
  if (options.prints_qr) {
    std::cout << "\n"
              << draw_on_terminal(make_qr_code(urls.front())) << "Pairing code: " << options.token
              << "\n";
  }
  std::cout.flush();
}

/** Prints and writes the QR code of an address, as the options request. */
void show_qr_code(const GatewayOptions& options, const std::string& url) {
  if (options.prints_qr) {
    std::cout << draw_on_terminal(make_qr_code(url)) << url << "\nPairing code: " << options.token
              << std::endl;
  }
  if (options.qr_file.empty()) return;
  replace_file(options.qr_file, draw_as_png(make_qr_code(url), kQrScale));
}

void run_gateway(const CommonOptions& common, GatewayOptions options) {
  // The library prints a line for every message that it cannot parse: any host could fill the log.
  google::protobuf::SetLogHandler(nullptr);
  // Before the addresses are printed, which contain the token.
  if (options.token.empty()) {
    options.token = options.token_file.empty() ? make_token() : token_from_file(options.token_file);
  }
  if (options.prints_addresses) {
    print_addresses(options);
    return;
  }
  prepare_tls(options);
  if (options.network.relay_file.empty() && !options.network.relay.empty()) {
    options.network.relay_file = default_relay_file();
  }
  const std::vector<RobotOption> robots = parse_robot_options(options.robots, options.model);
  if (options.has_bluetooth) options.network.bluetooth_name = robots.front().name;
  if (request_realtime_scheduling(RealtimePriority::kServing))
    logger::info("uses real-time scheduling (SCHED_RR)");
  Bus bus(common.lcm_url);
  logger::info("version {}, bus {}", version(), common.lcm_url);
  ExhibitionFiles exhibition_files(options.exhibition_state_file, options.exhibition_report_file);
  GatewayDaemon daemon(bus, describe_robots(robots, options.has_overview), options.limits,
                       options.token, options.audit_file,
                       make_exhibition(options, exhibition_files));
  const ExhibitionDesk* exhibition = daemon.core().exhibition();
  daemon.core().set_players(label_players(robots));
  WebPages pages(data_path());
  add_scene_page(pages, options.scene);
  Network network(options.network, make_access_rules(options), daemon.core(), pages);

  AsioLoop& loop = network.loop();
  size_t step_timer = 0;
  double last_step = 0;
  // Without a client messages wait for the next step.
  const auto set_busy = [&](bool is_busy) {
    loop.set_watched(bus.descriptor(), is_busy);
    loop.set_period(step_timer, is_busy ? kStepPeriod : kIdlePeriod);
  };
  const auto step = [&] {
    last_step = monotonic_seconds();
    daemon.step(last_step);
    set_busy(!daemon.core().sessions().all().empty());
  };
  // A step with the robot's states takes no wake-up of its own.
  loop.on_readable(bus.descriptor(), [&] {
    bus.handle();
    if (monotonic_seconds() < last_step + kLeastStepPeriod) return;
    step();
    loop.restart(step_timer);
  });
  step_timer = loop.every(kStepPeriod, [&] {
    bus.handle();
    step();
  });
  network.on_accepted([&] {
    bus.handle();
    set_busy(true);
  });
  loop.every_aligned(kStatusPeriod, [&] {
    daemon.publish_status(monotonic_seconds());
    if (exhibition != nullptr) exhibition_files.write(exhibition->state(), monotonic_seconds());
  });
  logger::info("HTTP and WebSocket on {}:{}, TCP on {}:{}", options.network.bind,
               network.http_port(), options.network.bind, network.tcp_port());
  const std::vector<std::string> urls = addresses_for_phones(options, network.http_port());
  for (const std::string& url : urls) logger::info("phones: {}", url);
  show_qr_code(options, urls.front());
  pages.add_page("/metrics", {"text/plain; version=0.0.4", true, [&daemon, &network] {
                                return daemon.metrics_text(network.metrics());
                              }});
  // The code of an exhibition hangs where everybody sees it.
  pages.add_page("/qr.png", {"image/png", exhibition == nullptr, [url = urls.front()] {
                               return draw_as_png(make_qr_code(url), kQrScale);
                             }});
  const std::optional<Announcement> announcement = make_announcement(options, robots, network);
  ServiceDiscovery discovery(announcement);
  DiscoveryLog discovery_log;
  if (announcement) {
    network.loop().every(kDiscoveryPeriod, [&] {
      discovery.step(monotonic_seconds());
      discovery_log.write(discovery, network.http_port());
    });
  }
  pages.add_page("/gateways",
                 {"application/json", false, [&discovery] { return gateways_to_json(discovery); }});
  daemon.publish_status(monotonic_seconds());

  // First the last messages of the core, then time to send them.
  const std::string reason = network.loop().run();
  // Before the phones are gone.
  if (exhibition != nullptr) exhibition_files.write_all(exhibition->state());
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
      "Lets phones drive robots: the app over HTTP, the protocol over WebSocket and TCP",
      "nao-phone-gateway");
  nao::CommonOptions common;
  nao::gateway::GatewayOptions options;
  nao::add_bus_options(app, common);
  nao::gateway::add_gateway_options(app, options);
  return nao::run_program(app, common, argc, argv,
                          [&] { nao::gateway::run_gateway(common, std::move(options)); });
}
