// nao-relay: connects phones with robots' gateways over the internet. docs/anywhere.md
#include <sys/resource.h>

#include <filesystem>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/data_path.h"
#include "common/logger.h"
#include "common/program.h"
#include "phone-gateway/relay/relay_server.h"
#include "phone-gateway/server/pairing/certificate.h"
#include "phone-gateway/server/pairing/own_addresses.h"
#include "phone-gateway/web_stream/access_rules.h"
#include "phone-gateway/web_stream/asio_loop.h"
#include "phone-gateway/web_stream/own_host.h"

namespace nao::relay {
namespace {

struct ProgramOptions {
  RelayOptions relay;
  std::vector<std::string> host_names;
  std::string tls_folder;
};

void add_options(CommandLine& app, ProgramOptions& options) {
  RelayOptions& relay = options.relay;
  app.add_option("--bind", relay.bind, "Address to listen on; 0.0.0.0: all, also of IPv6");
  app.add_option("--port", relay.port, "Port of phones and robots; 0: any free");
  app.add_option("--key", relay.key_file, "Key of --certificate, PEM")->existing_file();
  app.add_option("--certificate", relay.certificate_file,
                 "Certificate chain, PEM; default: one that the relay signs itself, before which "
                 "browsers warn")
      ->needs("--key")
      ->existing_file();
  app.add_option("--host-name", options.host_names,
                 "Name of this host in the certificate that the relay signs itself (repeatable)");
  app.add_option("--tls-dir", options.tls_folder,
                 "Folder of that certificate; default: ~/.local/state/nao-remote/relay");
  RelayLimits& limits = relay.limits;
  app.add_option("--max-phones", limits.max_phones, "Phones at most")->positive();
  app.add_option("--max-robots", limits.max_robots, "Robots at most")->positive();
  app.add_option("--max-phones-per-robot", limits.max_phones_per_robot, "Phones of one robot")
      ->positive();
  app.add_option("--max-phones-per-address", limits.max_phones_per_address,
                 "Phones from one address")
      ->positive();
  app.add_option("--max-robots-per-address", limits.max_robots_per_address,
                 "Robots from one address")
      ->positive();
}

void prepare_tls(ProgramOptions& options) {
  RelayOptions& relay = options.relay;
  if (relay.certificate_file.empty()) {
    std::vector<std::string> names = own_host_names();
    names.insert(names.end(), options.host_names.begin(), options.host_names.end());
    gateway::CertificateNames valid{AccessRules(names, {}).all_host_names(),
                                    gateway::own_addresses()};
    valid.addresses.push_back("127.0.0.1");
    const gateway::CertificateFiles files = gateway::own_certificate(
        options.tls_folder.empty() ? state_path() / "relay"
                                   : std::filesystem::path(options.tls_folder),
        valid);
    relay.certificate_file = files.certificate;
    relay.key_file = files.key;
    logger::warn(
        "the relay signs its certificate itself: every phone warns at its first visit, and its "
        "owner must accept it. --certificate takes one that phones trust");
  }
  logger::info("https with {}, SHA-256 {}", relay.certificate_file,
               gateway::certificate_fingerprint(relay.certificate_file));
}

/** Each phone takes two file descriptors, and the usual limit of a process is 1,024. */
void raise_descriptor_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  if (setrlimit(RLIMIT_NOFILE, &limit) != 0) logger::warn("cannot raise the number of open files");
}

void run(ProgramOptions options) {
  raise_descriptor_limit();
  prepare_tls(options);
  RelayServer server(options.relay);
  logger::info("version {}, listens on port {} of {}", version(), server.port(),
               options.relay.bind);
  logger::info("ends: {}", server.loop().run());
}

}  // namespace
}  // namespace nao::relay

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Connects phones with robots over the internet, for a server with a public address: robots' "
      "gateways (scripts/start --relay) dial out to it, phones open its https address. It cannot "
      "read what they exchange.",
      "nao-relay");
  nao::relay::ProgramOptions options;
  nao::relay::add_options(app, options);
  nao::CommonOptions common;
  // It has no bus, and so no --lcm-url.
  common.lcm_url = "memq://";
  app.add_version_flag("--version", app.name() + " " + nao::version());
  nao::add_log_option(app, common);
  return nao::run_program(app, common, argc, argv, [&options] { nao::relay::run(options); });
}
