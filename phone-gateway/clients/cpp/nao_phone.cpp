// nao-phone: a client of nao-phone-gateway for the command line, over raw TCP. See README.md.
#include <cctype>
#include <chrono>
#include <cstdio>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "common/command_line.h"
#include "common/output_file.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "messages/body_condition.h"
#include "phone-gateway/clients/cpp/phone_client.h"
#include "phone-gateway/discovery/gateway_list.h"
#include "phone-gateway/discovery/service_discovery.h"

namespace nao::phone {
namespace {

using naoremote::Notice;
using naoremote::Response;

/** s. Chosen: longer than any motion of the robot, getting up and a posture included. */
constexpr double kResultTimeout = 60;
/** s. Chosen: longer than the search for a ball, and than any way to a goal. */
constexpr double kPlayTimeout = 600;
/** s; see WalkTurn and GetState in PROTOCOL.md. */
constexpr double kWalkPeriod = 0.1;
/** Without commands for so long a walk ends, s; see PROTOCOL.md, "Driving". */
constexpr double kWalkSilence = 1;
constexpr double kPollPeriod = 0.1;
/** Polls until an image must have arrived: 5 s. */
constexpr int kMaxImagePolls = 50;

/** Values of the command line. */
struct PhoneOptions {
  PhoneClient::Options client;
  std::string posture;
  std::string action;
  std::string behavior;
  std::string group;
  std::string file;
  double x = 0;
  double y = 0;
  double theta = 0;
  double vx = 0;
  double vy = 0;
  double wz = 0;
  double yaw = 0;
  double pitch = 0;
  double roll = 0;
  double speed = 0;
  double duration = 5;
  double play_duration = 0;
  double timeout = 2;
  double rate = 10;
  double image_rate = 0;
  std::string camera;
};

/** "holding" for MODE_HOLDING, as nao-motion calls it. */
std::string mode_name(naoremote::Mode mode) {
  std::string name = naoremote::Mode_Name(mode);
  name.erase(0, std::string("MODE_").size());
  for (char& c : name) c = c == '_' ? '-' : static_cast<char>(std::tolower(c));
  return name;
}

void print_state(const naoremote::State& state, const naoremote::RobotDescription& robot) {
  std::printf("time %.2f s, age %.0f ms, mode %s, posture %s, torso height %.3f m\n",
              static_cast<double>(state.utime()) * 1e-6, state.age_ms(),
              mode_name(state.mode()).c_str(),
              state.posture().empty() ? "-" : state.posture().c_str(), state.torso_position(2));
  if (state.has_body()) {
    const naoremote::Body& body = state.body();
    if (body.has_battery_charge()) {
      std::printf("battery %.0f %%%s\n", 100 * static_cast<double>(body.battery_charge()),
                  body.is_charging() ? ", charging" : "");
    }
    if (!body.hottest_joint().empty()) {
      std::printf("hottest motor %s, %.0f degrees Celsius\n", body.hottest_joint().c_str(),
                  static_cast<double>(body.hottest_temperature()));
    }
    for (const std::string& code : body.warnings()) {
      std::printf("warning: %s\n", body_warning_text(code).c_str());
    }
  }
  for (int i = 0; i < state.joint_position_size(); ++i) {
    std::printf("%-16s %8.4f\n", robot.joints(i).name().c_str(),
                static_cast<double>(state.joint_position(i)));
  }
}

/** Prints a refusal. @return Exit status: 0 if the request was accepted. */
int report(const Response& response) {
  if (response.error() == naoremote::OK) return 0;
  std::cerr << naoremote::ErrorCode_Name(response.error()) << ": " << response.message() << "\n";
  return 1;
}

/** Takes control, sends a command, and waits for its result. */
int command(PhoneClient& client, const std::function<Response(PhoneClient&)>& send,
            double timeout = kResultTimeout) {
  if (const int status = report(client.take_control()); status != 0) return status;
  const Response response = send(client);
  if (const int status = report(response); status != 0) return status;
  const auto result = client.wait_for_result(response.request_id(), timeout);
  if (!result) {
    std::cerr << "no result within " << timeout << " s\n";
    return 1;
  }
  std::cout << Notice::Status_Name(result->status())
            << (result->message().empty() ? "" : ": " + result->message()) << "\n";
  return result->status() == Notice::DONE ? 0 : 1;
}

/** The behavior of a name such as "keep-goal"; NONE for "none" or an unknown name. */
naoremote::Play::Behavior find_behavior(std::string name) {
  for (char& c : name) c = c == '-' ? '_' : static_cast<char>(std::toupper(c));
  naoremote::Play::Behavior behavior = naoremote::Play::NONE;
  naoremote::Play::Behavior_Parse(name, &behavior);
  return behavior;
}

/** Lets the robot act until it is done. Ctrl-C ends it, as the connection closes. */
int play(PhoneClient& client, const PhoneOptions& options) {
  return command(
      client,
      [&options](PhoneClient& c) {
        naoremote::Request request;
        request.mutable_play()->set_behavior(find_behavior(options.behavior));
        return c.request(std::move(request));
      },
      options.play_duration > 0 ? options.play_duration : kPlayTimeout);
}

// The command is repeated all the time, as from a joystick: a walk ends by itself without it.
int walk(PhoneClient& client, const PhoneOptions& options) {
  if (const int status = report(client.take_control()); status != 0) return status;
  const double start = monotonic_seconds();
  double last = start;
  while (last - start < options.duration) {
    const Response response = client.walk_turn(options.vx, options.vy, options.wz);
    if (const int status = report(response); status != 0) return status;
    client.run_for(kWalkPeriod);
    const double now = monotonic_seconds();
    // After a suspension the robot stands, and must not begin to walk again by itself.
    if (now - last > kWalkSilence) {
      std::fprintf(stderr, "nao-phone: the walk has ended: this program was held up\n");
      return 1;
    }
    last = now;
  }
  // Zero velocity ends the walk at once.
  return report(client.walk_turn(0, 0, 0));
}

int show_state(PhoneClient& client) {
  const Response response = client.get_state(false);
  if (const int status = report(response); status != 0) return status;
  print_state(response.state_and_image().state(), client.robot());
  return 0;
}

int save_image(PhoneClient& client, const std::string& file, const std::string& camera) {
  // The camera starts to render with the first request.
  Response response = client.get_state(true, camera);
  for (int i = 0; i < kMaxImagePolls && response.error() == naoremote::OK &&
                  !response.state_and_image().has_image();
       ++i) {
    client.run_for(kPollPeriod);
    response = client.get_state(true, camera);
  }
  if (const int status = report(response); status != 0) return status;
  if (!response.state_and_image().has_image()) {
    std::cerr << "the head camera sends no image\n";
    return 1;
  }
  const naoremote::Image& image = response.state_and_image().image();
  replace_file(file, image.jpeg());
  std::cout << file << ": " << image.width() << "x" << image.height() << ", age " << image.age_ms()
            << " ms\n";
  return 0;
}

/** Prints a line for each state, image and notice, for the requested duration. */
int watch(const PhoneOptions& options) {
  PhoneClient::Handlers handlers;
  handlers.on_state = [](const naoremote::State& state) {
    std::printf(
        "%.3f s  %-10s %-10s height %.3f m  walk %+.2f %+.2f m/s %+.2f rad/s  age %.0f ms\n",
        static_cast<double>(state.utime()) * 1e-6, mode_name(state.mode()).c_str(),
        state.posture().c_str(), static_cast<double>(state.torso_position(2)),
        static_cast<double>(state.vx()), static_cast<double>(state.vy()),
        static_cast<double>(state.wz()), state.age_ms());
  };
  handlers.on_notice = [](const Notice& notice) {
    std::printf("%s %s\n", Notice::Kind_Name(notice.kind()).c_str(), notice.message().c_str());
  };
  handlers.on_image = [](const naoremote::Image& image) {
    std::printf("image %ux%u, %zu bytes, age %.0f ms\n", image.width(), image.height(),
                image.jpeg().size(), image.age_ms());
  };
  PhoneClient client(options.client, handlers);
  if (const int status = report(client.subscribe(options.rate, options.image_rate)); status != 0)
    return status;
  client.run_for(options.duration);
  return 0;
}

int list_clients(const PhoneOptions& options) {
  const Response response =
      operate(options.client.host, options.client.port, naoremote::Operate::LIST);
  if (const int status = report(response); status != 0) return status;
  for (const auto& client : response.clients().clients()) {
    std::printf("%4u  %-20s %-16s %-10s%s%s%s\n", client.client_id(), client.name().c_str(),
                client.address().c_str(), client.transport().c_str(),
                client.is_driver()  ? " drives"
                : client.is_muted() ? " may only watch"
                                    : "",
                client.robot().empty() ? "" : " ", client.robot().c_str());
  }
  return 0;
}

/** Prints the robots of the gateway; of one robot only its name and model. */
int list_robots(const PhoneClient& client) {
  if (client.connected().robots().robots().empty()) {
    std::printf("%-20s %s\n", client.robot().name().c_str(), client.robot().model().c_str());
  }
  for (const auto& robot : client.connected().robots().robots()) {
    std::string team;
    if (robot.has_team()) team = "team " + std::to_string(robot.team());
    if (robot.number() > 0) team += " number " + std::to_string(robot.number());
    const std::string driver = robot.driver_id() != 0 ? robot.driver_name() + " drives"
                               : robot.is_available() ? "free"
                                                      : "does not answer";
    std::printf("%-20s %-12s %-16s %s\n", robot.name().c_str(), robot.model().c_str(), team.c_str(),
                driver.c_str());
  }
  return 0;
}

/** Lists the gateways that are found within some time. @return Exit status: 0 if there is one. */
int list_gateways(double timeout) {
  ServiceDiscovery discovery(std::nullopt);
  const double end = monotonic_seconds() + timeout;
  while (monotonic_seconds() < end) {
    discovery.step(monotonic_seconds());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::cout << gateways_to_text(discovery.found());
  if (!discovery.found().empty()) return 0;
  std::cerr << "nao-phone: no gateway is announced in this network"
            << (discovery.problem().empty() ? "" : ": " + discovery.problem()) << "\n";
  return 1;
}

/** Prints why a walk was refused: its commands are answered OK, the refusal is a notice. */
void print_refusal(const Notice& notice) {
  const bool is_bad = notice.kind() == Notice::COMMAND_RESULT &&
                      (notice.status() == Notice::REFUSED || notice.status() == Notice::FAILED);
  if (is_bad) std::cerr << notice.message() << "\n";
}

/** Adds a subcommand that connects and then calls `act`. */
CommandLine* add_action(CommandLine& app, PhoneOptions& options, std::function<int()>& chosen,
                        const std::string& name, const std::string& description,
                        std::function<int(PhoneClient&)> act) {
  CommandLine* subcommand = app.add_subcommand(name, description);
  subcommand->on_parsed([&options, &chosen, act = std::move(act)] {
    chosen = [&options, act] {
      PhoneClient::Handlers handlers;
      handlers.on_notice = print_refusal;
      PhoneClient client(options.client, handlers);
      return act(client);
    };
  });
  return subcommand;
}

void add_subcommands(CommandLine& app, PhoneOptions& o, std::function<int()>& chosen) {
  app.require_subcommand();
  CommandLine* gateways = app.add_subcommand(
      "gateways", "List the gateways in the local network; needs avahi-daemon on this host");
  gateways->add_option("--timeout", o.timeout, "How long to look for them, s");
  gateways->on_parsed([&o, &chosen] { chosen = [&o] { return list_gateways(o.timeout); }; });
  add_action(app, o, chosen, "robots", "List the robots of the gateway and who drives them",
             list_robots);
  add_action(app, o, chosen, "state", "Show the robot's state", show_state);
  CommandLine* image =
      add_action(app, o, chosen, "image", "Save an image of the head camera",
                 [&o](PhoneClient& client) { return save_image(client, o.file, o.camera); });
  image->add_option("file", o.file, "JPEG file to write")->required();
  image->add_option("--camera", o.camera,
                    "Of the robot's cameras, or \"overview\" in a match (default: its first one)");

  CommandLine* posture =
      add_action(app, o, chosen, "posture", "Go to a posture", [&o](PhoneClient& c) {
        return command(
            c, [&o](PhoneClient& client) { return client.go_to_posture(o.posture, o.speed); });
      });
  posture->add_option("name", o.posture, "Posture, such as Crouch")->required();
  posture->add_option("--speed", o.speed,
                      "Fraction of the maximum speed, above 0 up to 1; 0: the gateway's default");

  CommandLine* joints = add_action(app, o, chosen, "joints", "Turn joints", [&o](PhoneClient& c) {
    return command(c, [&o](PhoneClient& client) {
      return client.change_joints(o.group, o.yaw, o.pitch, o.roll, o.speed);
    });
  });
  joints->add_option("group", o.group, "Joint group, such as head or \"left shoulder\"")
      ->required();
  joints->add_option("--yaw", o.yaw, "Change about this axis, rad");
  joints->add_option("--pitch", o.pitch, "Change about this axis, rad (hands: opening)");
  joints->add_option("--roll", o.roll, "Change about this axis, rad");
  joints->add_option("--speed", o.speed,
                     "Fraction of the maximum speed, above 0 up to 1; 0: the gateway's default");

  CommandLine* action = add_action(app, o, chosen, "action", "Do an action", [&o](PhoneClient& c) {
    return command(c, [&o](PhoneClient& client) { return client.do_action(o.action); });
  });
  action->add_option("name", o.action, "Action, such as wave")->required();

  CommandLine* playing =
      add_action(app, o, chosen, "play", "Let the robot act by itself until it is done",
                 [&o](PhoneClient& client) { return play(client, o); });
  playing->add_option("behavior", o.behavior, "go-to-ball, kick, dribble, score or keep-goal")
      ->required()
      ->check([](const std::string& name) {
        return find_behavior(name) == naoremote::Play::NONE ? "there is no behavior '" + name + "'"
                                                            : std::string();
      });
  playing->add_option("--duration", o.play_duration, "End it after this time, s (default: 600)");

  CommandLine* walking = add_action(app, o, chosen, "walk", "Walk and turn",
                                    [&o](PhoneClient& client) { return walk(client, o); });
  CommandLine* move = add_action(
      app, o, chosen, "move", "Walk to a goal relative to the present pose", [&o](PhoneClient& c) {
        return command(c, [&o](PhoneClient& client) { return client.move_to(o.x, o.y, o.theta); });
      });
  walking->add_option("vx", o.vx, "Velocity forward, m/s; negative: backward")->required();
  walking->add_option("vy", o.vy, "Velocity to the left, m/s");
  walking->add_option("wz", o.wz, "Turning rate to the left, rad/s");
  walking->add_option("--duration", o.duration, "How long, s");
  move->add_option("x", o.x, "Forward, m")->required();
  move->add_option("y", o.y, "To the left, m");
  move->add_option("theta", o.theta, "Heading at the goal relative to the present one, rad");

  add_action(app, o, chosen, "stop", "End any motion",
             [](PhoneClient& client) { return report(client.stop()); });

  CommandLine* watching =
      app.add_subcommand("watch", "Print states, images and notices as they are received");
  watching->add_option("--duration", o.duration, "How long, s");
  watching->add_option("--rate", o.rate, "States a second, up to 60");
  watching->add_option("--images", o.image_rate, "Images a second, up to 30");
  watching->on_parsed([&] { chosen = [&o] { return watch(o); }; });
  app.add_subcommand("list", "List the connected clients (on the gateway's host only)")
      ->on_parsed([&] { chosen = [&o] { return list_clients(o); }; });
}

}  // namespace
}  // namespace nao::phone

int main(int argc, char** argv) {
  nao::CommandLine app("A client for the command line: drives the robot through nao-phone-gateway",
                       "nao-phone");
  nao::CommonOptions common;
  nao::phone::PhoneOptions options;
  options.client.name = "nao-phone";
  options.client.software = std::string("nao-phone ") + nao::version();
  app.add_version_flag("--version", app.name() + " " + nao::version());
  app.add_option("--host", options.client.host, "The gateway's host");
  app.add_option("--port", options.client.port, "Its TCP port");
  app.add_option("--token", options.client.token,
                 "Pairing token; not needed on the gateway's own host");
  app.add_option("--name", options.client.name, "Name that other clients see");
  app.add_option("--robot", options.client.robot,
                 "Robot of a gateway of several (default: the first one that nobody drives)");
  std::function<int()> chosen;
  nao::phone::add_subcommands(app, options, chosen);
  return nao::run_program_with_status(app, common, argc, argv, [&] { return chosen(); });
}
