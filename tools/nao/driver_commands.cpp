// Operator commands: control leases of phones. They use the gateway's protocol, not the bus.

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/json_writer.h"
#include "phone-gateway/clients/cpp/phone_client.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/text_table.h"

namespace nao {
namespace {

using naoremote::Operate;
using naoremote::Response;

/** Options of the subcommands of `driver`. */
struct DriverOptions {
  /** Port of the gateway on this host. */
  uint16_t port = 7668;
  uint32_t client_id = 0;
  /** Name of a robot; may be empty. */
  std::string robot{};
  bool as_json = false;
};

/** @return The exit status. */
int run_operation(const DriverOptions& options, Operate::Operation operation,
                  const std::string& name, Response& response) {
  try {
    response = operate("127.0.0.1", options.port, operation, options.client_id, options.robot);
  } catch (const ConnectionError& error) {
    std::fprintf(stderr, "nao: driver %s: %s; is nao-phone-gateway running on this host?\n",
                 name.c_str(), error.what());
    return 1;
  }
  if (response.error() == naoremote::OK) return 0;
  std::fprintf(stderr, "nao: driver %s: refused: %s\n", name.c_str(), response.message().c_str());
  return 1;
}

void print_json(const naoremote::Clients& clients) {
  JsonWriter json;
  json.begin_array();
  for (const auto& client : clients.clients()) {
    json.begin_object();
    json.add("client_id", static_cast<int64_t>(client.client_id()));
    json.add("name", client.name());
    json.add("address", client.address());
    json.add("transport", client.transport());
    json.add("is_driver", client.is_driver());
    json.add("robot", client.robot());
    json.add("is_muted", client.is_muted());
    json.add("num_sent", static_cast<int64_t>(client.num_sent()));
    json.add("num_skipped", static_cast<int64_t>(client.num_skipped()));
    json.end();
  }
  std::printf("%s\n", json.take().c_str());
}

void print_table(const naoremote::Clients& clients) {
  std::vector<std::vector<std::string>> rows = {
      {"client", "name", "address", "by", "robot", "drives", "sent", "skipped"}};
  for (const auto& client : clients.clients()) {
    rows.push_back({std::to_string(client.client_id()), client.name(), client.address(),
                    client.transport(), client.robot(),
                    client.is_driver()  ? "drives"
                    : client.is_muted() ? "muted"
                                        : "",
                    std::to_string(client.num_sent()), std::to_string(client.num_skipped())});
  }
  std::printf("%s", format_table(rows).c_str());
}

int list(const DriverOptions& options) {
  Response response;
  const int status = run_operation(options, Operate::LIST, "list", response);
  if (status != 0) return status;
  if (options.as_json) {
    print_json(response.clients());
  } else if (response.clients().clients().empty()) {
    std::printf("no phone is connected\n");
  } else {
    print_table(response.clients());
  }
  return 0;
}

}  // namespace

void add_driver_commands(CommandLine& app, Invocation& invocation) {
  CommandLine* driver = app.add_subcommand(
      "driver", "List and change who drives from a phone (on the gateway's host)");
  driver->require_subcommand();
  const auto options = std::make_shared<DriverOptions>();
  driver->add_option("--port", options->port, "TCP port of the gateway");

  CommandLine* listing =
      driver->add_subcommand("list", "List the connected clients and the current driver");
  listing->add_flag("--json", options->as_json, "As JSON");
  invocation.on(*listing, [options](const auto& /*common*/) { return list(*options); });

  const auto add = [&](const std::string& name, const std::string& description,
                       Operate::Operation operation) {
    CommandLine* subcommand = driver->add_subcommand(name, description);
    invocation.on(*subcommand, [options, operation, name](const auto& /*common*/) {
      Response response;
      return run_operation(*options, operation, name, response);
    });
    return subcommand;
  };
  const auto add_client = [&](CommandLine* subcommand) {
    subcommand->add_option("client", options->client_id, "Client number, as printed by list")
        ->required();
    return subcommand;
  };
  const char* const kEvery = "Name of one of several robots (default: every one)";
  add("take", "Take the control lease: phones are refused until release", Operate::TAKE)
      ->add_option("robot", options->robot, kEvery);
  add("release", "Release the control lease: phones may drive again", Operate::RELEASE)
      ->add_option("robot", options->robot, kEvery);
  add_client(add("kick", "Close the connection of a client", Operate::KICK));
  add_client(add("mute", "Let a client watch only, until unmute or its end", Operate::MUTE));
  add_client(add("unmute", "Let a client drive again", Operate::UNMUTE));
  add_client(add("assign", "Let a client drive a robot, also if another one drove it before",
                 Operate::ASSIGN))
      ->add_option("robot", options->robot,
                   "Name of one of several robots (default: the one that it watches)");
}

}  // namespace nao
