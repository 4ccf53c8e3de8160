// Measures what the gateway costs: the way of a command from a phone to the joints, the age of what
// phones see, and 32 phones at once. Starts simulator, motion, camera and gateway on a bus of its
// own.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <optional>
#include <random>
#include <regex>
#include <set>
#include <stdexcept>
#include <thread>

#include "common/bus.h"
#include "common/channels.h"
#include "common/child_process.h"
#include "common/command_line.h"
#include "common/logger.h"
#include "common/scheduling.h"
#include "common/wall_clock.h"
#include "tools/bench/disturbing_clients.h"
#include "tools/bench/figures.h"
#include "tools/bench/wire_client.h"

namespace {

using nao::Bus;
using nao::ChildProcess;
using nao::Figure;
using nao::monotonic_seconds;
using nao::percentile;
using nao::WireClient;

constexpr double kDeadline = 60;
/** Change of the head yaw, rad. Chosen: executed within half a second, far from the limits. */
constexpr double kYawChange = 0.4;
/** The joint has moved when its encoder (steps of 0.0015 rad, no other noise) reads the next step
 * on the way to the goal. Before, the reading has stood still for this long, s. */
constexpr double kMoved = 0.001;
constexpr double kStillTime = 0.2;
/** The simulator's control tick, s. */
constexpr double kTick = 0.01;
constexpr int kNumClients = 32;

naoremote::Request hello(const std::string& name) {
  naoremote::Request request;
  request.set_request_id(1);
  request.mutable_connect()->set_protocol_version(1);
  request.mutable_connect()->set_client_name(name);
  return request;
}

/** The programs, and what they say on the bus. */
class Stack {
 public:
  explicit Stack(const std::string& lcm_url) : bus_(lcm_url) {
    const std::string folder = nao::program_folder();
    const auto start = [&](const std::string& name, std::vector<std::string> options) {
      std::vector<std::string> command = {folder + "/" + name, "--lcm-url", lcm_url};
      command.insert(command.end(), options.begin(), options.end());
      programs_[name] = std::make_unique<ChildProcess>(command);
    };
    subscribe();
    start("nao-sim", {});
    start("nao-motion", {});
    start("nao-head-camera", {});
    start("nao-phone-gateway", {"--bind", "127.0.0.1", "--http-port", "0", "--tcp-port", "0"});
    run_until([this] { return ready_.size() == programs_.size(); }, "every program is ready");
    std::smatch ports;
    const std::string log = gateway().output();
    if (!std::regex_search(log, ports,
                           std::regex("WebSocket on [^ ]*:(\\d+), TCP on [^ ]*:(\\d+)"))) {
      throw std::runtime_error("the gateway does not listen:\n" + log);
    }
    http_port_ = static_cast<uint16_t>(std::stoi(ports[1]));
    tcp_port_ = static_cast<uint16_t>(std::stoi(ports[2]));
    run_for(1);
  }

  uint16_t http_port() const { return http_port_; }
  uint16_t tcp_port() const { return tcp_port_; }
  const ChildProcess& program(const std::string& name) const { return *programs_.at(name); }
  const ChildProcess& gateway() const { return program("nao-phone-gateway"); }
  Bus& bus() { return bus_; }

  /** Has `handler` called with every message that comes to a client, inside run_...(). */
  void watch(WireClient* client,
             std::function<void(const naoremote::ServerMessage&, double)> handler) {
    clients_.push_back({client, std::move(handler)});
  }
  void forget_clients() { clients_.clear(); }

  void run_until(const std::function<bool()>& is_done, const std::string& what) {
    const double deadline = monotonic_seconds() + kDeadline;
    while (!is_done()) {
      if (monotonic_seconds() > deadline) throw std::runtime_error("waited in vain: " + what);
      pump(0.1);
    }
  }
  void run_for(double time) {
    const double deadline = monotonic_seconds() + time;
    while (monotonic_seconds() < deadline) pump(deadline - monotonic_seconds());
  }

  /** Target and measured angle of the head's yaw, rad, and when each was heard. */
  double yaw_target = 0;
  double yaw = 0;
  double yaw_target_time = 0;
  double yaw_time = 0;
  /** Since when the measured angle has been what it is, s. */
  double yaw_still_since = 0;

  /** When the state of a robot time was on the bus, s; nothing if it was not heard. */
  std::optional<double> time_of_state(uint64_t utime) const {
    const auto found = state_times_.find(static_cast<int64_t>(utime));
    return found == state_times_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  template <class Message>
  static std::optional<double> head_yaw(const Message& message) {
    for (int i = 0; i < message.num_joints; ++i) {
      if (message.joint_names[i] == "HeadYaw") return message.joint_position[i];
    }
    return std::nullopt;
  }

  void subscribe() {
    const nao::RobotChannels channels;
    bus_.subscribe<naolcm::joint_command_t>(channels.joint_command, Bus::Queue::kAll,
                                            [this](const auto& message) {
                                              if (const auto angle = head_yaw(message))
                                                yaw_target = *angle;
                                              yaw_target_time = monotonic_seconds();
                                            });
    bus_.subscribe<naolcm::sensor_state_t>(channels.sensor_state, Bus::Queue::kAll,
                                           [this](const auto& message) {
                                             const double last = yaw;
                                             if (const auto angle = head_yaw(message)) yaw = *angle;
                                             yaw_time = monotonic_seconds();
                                             if (yaw != last) yaw_still_since = yaw_time;
                                           });
    bus_.subscribe<naolcm::robot_state_t>(channels.robot_state, Bus::Queue::kAll,
                                          [this](const auto& message) {
                                            state_times_[message.utime] = monotonic_seconds();
                                            if (state_times_.size() > 1000)
                                              state_times_.erase(state_times_.begin());
                                          });
    bus_.subscribe<naolcm::daemon_status_t>(nao::kDaemonStatusChannel, Bus::Queue::kAll,
                                            [this](const auto& message) {
                                              if (message.state == "ready")
                                                ready_.insert(message.program);
                                            });
  }

  /** Handles what the bus and the clients have, waiting for it if need be. */
  void pump(double timeout) {
    std::vector<pollfd> polled = {{bus_.descriptor(), POLLIN, 0}};
    for (const Watched& watched : clients_) {
      polled.push_back({watched.client->descriptor(), POLLIN, 0});
    }
    poll(polled.data(), polled.size(), std::max(0, static_cast<int>(timeout * 1e3)));
    if (polled[0].revents != 0) bus_.handle();
    // First all that has come, then what it says: no phone waits until another has decoded.
    std::vector<double> times(polled.size());
    for (size_t i = 1; i < polled.size(); ++i) {
      if (polled[i].revents == 0) continue;
      clients_[i - 1].client->read();
      times[i] = monotonic_seconds();
    }
    for (size_t i = 1; i < polled.size(); ++i) {
      if (polled[i].revents == 0) continue;
      for (const auto& message : clients_[i - 1].client->take_messages()) {
        clients_[i - 1].handler(message, times[i]);
      }
    }
  }

  struct Watched {
    WireClient* client;
    std::function<void(const naoremote::ServerMessage&, double)> handler;
  };

  Bus bus_;
  std::map<std::string, std::unique_ptr<ChildProcess>> programs_;
  std::set<std::string> ready_;
  uint16_t http_port_ = 0;
  uint16_t tcp_port_ = 0;
  std::vector<Watched> clients_;
  std::map<int64_t, double> state_times_;
};

/** Times from asking for a joint's change to what follows, ms. */
struct WayTimes {
  /** To the next measurement: no command is looked at earlier. */
  std::vector<double> to_tick_ms;
  std::vector<double> to_command_ms;
  std::vector<double> to_moved_ms;
};

/** Turns the head and times what follows.
 * @param ask  Sends the change, rad.
 * @param phase  How long after a measurement it is asked for, s, in [0, kTick]. */
void time_way(Stack& stack, const std::function<void(double)>& ask, double change, double phase,
              WayTimes& times) {
  const double heard_before = stack.yaw_time;
  stack.run_until(
      [&] {
        return stack.yaw_time > heard_before && stack.yaw_time - stack.yaw_still_since > kStillTime;
      },
      "the head is at rest");
  stack.run_for(phase);
  const double target_before = stack.yaw_target;
  const double yaw_before = stack.yaw;
  const double direction = change > 0 ? 1 : -1;
  const double start = monotonic_seconds();
  ask(change);
  double tick_time = 0;
  double command_time = 0;
  double moved_time = 0;
  stack.run_until(
      [&] {
        if (tick_time == 0 && stack.yaw_time > start) tick_time = stack.yaw_time;
        if (command_time == 0 && std::abs(stack.yaw_target - target_before) > 1e-6) {
          command_time = stack.yaw_target_time;
        }
        if (moved_time == 0 && (stack.yaw - yaw_before) * direction > kMoved) {
          moved_time = stack.yaw_time;
        }
        return command_time > 0 && moved_time > 0;
      },
      "the head turns");
  times.to_tick_ms.push_back((tick_time - start) * 1e3);
  times.to_command_ms.push_back((command_time - start) * 1e3);
  times.to_moved_ms.push_back((moved_time - start) * 1e3);
}

/** Moments of the control tick, one in each of `num` equal parts of it, in random order, s. The
 * median over phases drawn freely would scatter by 0.8 ms with 40 of them. */
std::vector<double> tick_phases(int num, std::mt19937& random) {
  std::uniform_real_distribution<double> within_part(0, 1);
  std::vector<double> phases;
  for (int i = 0; i < num; ++i) phases.push_back((i + within_part(random)) / num * kTick);
  std::shuffle(phases.begin(), phases.end(), random);
  return phases;
}

/** The way of a command over raw TCP, over WebSocket, and straight on the bus without a gateway: in
 * turns, at all moments of the control tick alike. */
std::map<std::string, WayTimes> measure_ways(Stack& stack, int num_rounds) {
  const auto tcp = nao::connect_tcp(stack.tcp_port());
  const auto websocket = nao::connect_websocket(stack.http_port());
  for (WireClient* client : {tcp.get(), websocket.get()}) {
    client->send(hello("bench"));
    stack.watch(client, [](const auto&, double) {});
  }
  const auto ask_phone = [](WireClient& client) {
    return [&client](double change) {
      naoremote::Request request;
      request.mutable_change_joints()->set_group("head");
      request.mutable_change_joints()->set_yaw(change);
      request.mutable_change_joints()->set_speed(1);
      client.send(request);
    };
  };
  int64_t command_id = nao::wall_utime();
  const auto ask_bus = [&](double change) {
    naolcm::joint_change_command_t command{};
    command.source = "bench." + std::to_string(getpid());
    command.command_id = ++command_id;
    command.num_joints = 1;
    command.joint_names = {"HeadYaw"};
    command.joint_position = {change};
    command.joint_stiffness = {std::numeric_limits<double>::quiet_NaN()};
    command.is_relative = 1;
    command.speed = 1;
    stack.bus().publish(nao::RobotChannels().joint_change_command, command);
  };
  const std::vector<std::pair<std::string, std::function<void(double)>>> ways = {
      {"tcp", ask_phone(*tcp)}, {"websocket", ask_phone(*websocket)}, {"bus", ask_bus}};

  std::map<std::string, WayTimes> times;
  std::map<std::string, std::vector<double>> phases;
  std::mt19937 random(1);
  for (const auto& [name, ask] : ways) phases[name] = tick_phases(num_rounds, random);
  constexpr double kPause = 0.3;
  double change = kYawChange;
  for (int round = 0; round < num_rounds; ++round) {
    for (const auto& [name, ask] : ways) {
      WireClient* driver = name == "tcp"         ? tcp.get()
                           : name == "websocket" ? websocket.get()
                                                 : nullptr;
      naoremote::Request request;
      request.mutable_take_control();
      if (driver != nullptr) driver->send(request);
      stack.run_for(kPause);
      time_way(stack, ask, change, phases[name][static_cast<size_t>(round)], times[name]);
      change = -change;
      stack.run_for(kPause);
      request.mutable_release_control();
      if (driver != nullptr) driver->send(request);
      // Both connections stay alive.
      request.mutable_ping();
      tcp->send(request);
      websocket->send(request);
    }
  }
  stack.forget_clients();
  return times;
}

/** What the clients saw in some seconds. */
struct Watching {
  std::vector<double> state_age_ms;
  std::vector<double> image_age_ms;
  double num_states = 0;
  double num_images = 0;
  double state_bytes = 0;
  double image_bytes = 0;
  double cpu_percent = 0;
  double rss_mib = 0;
};

/** Lets clients watch, half of them over WebSocket. Ages: from when the state that is shown was on
 * the bus to when it is here. */
Watching watch(Stack& stack, int num_clients, double state_rate, double image_rate, double time) {
  std::vector<std::unique_ptr<WireClient>> clients;
  Watching seen;
  for (int i = 0; i < num_clients; ++i) {
    clients.push_back(i % 2 == 0 ? nao::connect_tcp(stack.tcp_port())
                                 : nao::connect_websocket(stack.http_port()));
    clients.back()->send(hello("bench " + std::to_string(i)));
    naoremote::Request request;
    request.mutable_subscribe()->set_state_rate(state_rate);
    request.mutable_subscribe()->set_image_rate(image_rate);
    clients.back()->send(request);
    stack.watch(clients.back().get(), [&](const naoremote::ServerMessage& message, double now) {
      if (message.has_state()) {
        if (const auto then = stack.time_of_state(message.state().utime())) {
          seen.state_age_ms.push_back((now - *then) * 1e3);
        }
        ++seen.num_states;
        seen.state_bytes += static_cast<double>(message.ByteSizeLong());
      } else if (message.has_image()) {
        if (const auto then = stack.time_of_state(message.image().utime())) {
          seen.image_age_ms.push_back((now - *then) * 1e3);
        }
        ++seen.num_images;
        seen.image_bytes += static_cast<double>(message.ByteSizeLong());
      }
    });
  }
  const auto run_alive = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(seconds); ++i) {
      naoremote::Request ping;
      ping.mutable_ping();
      for (const auto& client : clients) client->send(ping);
      stack.run_for(1);
    }
  };
  run_alive(2);
  seen = {};
  const double cpu_before = stack.gateway().cpu_seconds();
  const double start = monotonic_seconds();
  run_alive(time);
  const double elapsed = monotonic_seconds() - start;
  seen.cpu_percent = (stack.gateway().cpu_seconds() - cpu_before) / elapsed * 100;
  seen.rss_mib = stack.gateway().rss_mib();
  stack.forget_clients();
  return seen;
}

/** Times until a phone is told that a part hangs, and that it is back, s. */
struct LossTimes {
  double told_s = 0;
  double back_s = 0;
};

LossTimes time_loss(Stack& stack, WireClient& phone, const std::string& program,
                    naoremote::Notice::Component component) {
  std::optional<bool> is_available;
  stack.watch(&phone, [&](const naoremote::ServerMessage& message, double) {
    if (message.has_notice() && message.notice().kind() == naoremote::Notice::COMPONENT_CHANGED &&
        message.notice().component() == component) {
      is_available = message.notice().is_available();
    }
  });
  const auto time_until = [&](bool expected, int signal) {
    kill(stack.program(program).pid(), signal);
    const double start = monotonic_seconds();
    double next_ping = 0;
    stack.run_until(
        [&] {
          if (monotonic_seconds() > next_ping) {
            naoremote::Request ping;
            ping.mutable_ping();
            phone.send(ping);
            next_ping = monotonic_seconds() + 1;
          }
          return is_available == expected;
        },
        "the client is notified of " + program);
    return monotonic_seconds() - start;
  };
  LossTimes times;
  times.told_s = time_until(false, SIGSTOP);
  times.back_s = time_until(true, SIGCONT);
  stack.forget_clients();
  return times;
}

/** Stops each part for a while under the eyes of a phone. */
void measure_losses(Stack& stack, std::vector<Figure>& figures) {
  const auto phone = nao::connect_tcp(stack.tcp_port());
  phone->send(hello("bench"));
  const auto measure = [&](const std::string& program, naoremote::Notice::Component component,
                           double image_rate, const std::string& name) {
    naoremote::Request request;
    request.mutable_subscribe()->set_state_rate(30);
    request.mutable_subscribe()->set_image_rate(image_rate);
    phone->send(request);
    stack.watch(phone.get(), [](const auto&, double) {});
    // A camera that is not watched any more draws for 2 s.
    stack.run_for(3);
    stack.forget_clients();
    const LossTimes times = time_loss(stack, *phone, program, component);
    figures.push_back({"gateway.told_of_lost_" + name + "_s", times.told_s, "s", "promised", 2});
    figures.push_back(
        {"gateway.told_of_lost_" + name + "_s.back", times.back_s, "s", "promised", 2});
  };
  measure("nao-head-camera", naoremote::Notice::CAMERA, 15, "camera");
  measure("nao-head-camera", naoremote::Notice::CAMERA, 0, "unwatched_camera");
  measure("nao-motion", naoremote::Notice::MOTION, 15, "motion");
  measure("nao-sim", naoremote::Notice::ROBOT, 15, "robot");
}

int connect_plain(uint16_t port) {
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("the bare sender does not listen");
  }
  return descriptor;
}

/** Processor time of a bare Asio loop that sends as many bytes as often, percent of a core. */
double measure_bare_sender(const Watching& seen, double state_rate, double image_rate,
                           double time) {
  const auto bytes = [](double sum, double number) {
    return std::to_string(static_cast<int>(number > 0 ? sum / number : 0) + 4);
  };
  const ChildProcess sender({nao::program_folder() + "/nao-bare-sender", std::to_string(state_rate),
                             bytes(seen.state_bytes, seen.num_states), std::to_string(image_rate),
                             bytes(seen.image_bytes, seen.num_images)});
  std::smatch port;
  std::string output;
  for (int i = 0; i < 100 && !std::regex_search(output, port, std::regex("port (\\d+)")); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    output = sender.output();
  }
  if (port.empty()) throw std::runtime_error("the bare sender does not start");
  std::vector<pollfd> polled;
  for (int i = 0; i < kNumClients; ++i) {
    polled.push_back({connect_plain(static_cast<uint16_t>(std::stoi(port[1]))), POLLIN, 0});
  }
  const double cpu_before = sender.cpu_seconds();
  const double start = monotonic_seconds();
  std::vector<char> part(65536);
  while (monotonic_seconds() < start + time) {
    poll(polled.data(), polled.size(), 100);
    for (const pollfd& one : polled) {
      if (one.revents != 0 && recv(one.fd, part.data(), part.size(), 0) <= 0) {
        throw std::runtime_error("the bare sender ended");
      }
    }
  }
  const double percent = (sender.cpu_seconds() - cpu_before) / (monotonic_seconds() - start) * 100;
  for (const pollfd& one : polled) close(one.fd);
  return percent;
}

void report_ways(Stack& stack, int num_rounds, std::vector<Figure>& figures) {
  auto ways = measure_ways(stack, num_rounds);
  for (const auto& [name, suffix] : {std::pair{"tcp", ""}, std::pair{"websocket", ".websocket"}}) {
    for (const auto& [share, word] : {std::pair{0.5, "p50"}, std::pair{0.99, "p99"}}) {
      const std::string end = std::string(suffix) + "." + word;
      figures.push_back({"gateway.to_joint_command_ms" + end,
                         percentile(ways[name].to_command_ms, share), "ms", "straight on the bus",
                         percentile(ways["bus"].to_command_ms, share)});
      figures.push_back({"gateway.to_moved_joint_ms" + end,
                         percentile(ways[name].to_moved_ms, share), "ms", "straight on the bus",
                         percentile(ways["bus"].to_moved_ms, share)});
    }
  }

  std::vector<double> to_tick;
  for (const auto& [name, way] : ways) {
    to_tick.insert(to_tick.end(), way.to_tick_ms.begin(), way.to_tick_ms.end());
  }
  figures.push_back(
      {"gateway.to_tick_ms.p50", percentile(to_tick, 0.5), "ms", "half of a 10 ms tick", 5});
  figures.push_back({"gateway.to_tick_ms.p99", percentile(to_tick, 0.99), "ms", "a tick", 10});
}

void report_watching(Stack& stack, double time, std::vector<Figure>& figures) {
  const Watching one = watch(stack, 1, 60, 30, time);
  figures.push_back({"gateway.state_age_ms.p99", percentile(one.state_age_ms, 0.99), "ms", "", 0});
  figures.push_back({"gateway.image_age_ms.p95", percentile(one.image_age_ms, 0.95), "ms", "", 0});
  figures.push_back({"gateway.state_rate_hz", one.num_states / time, "1/s", "asked for", 60});
  figures.push_back({"gateway.image_rate_hz", one.num_images / time, "1/s", "asked for", 30});

  const Watching few = watch(stack, 1, 30, 15, time);
  const Watching many = watch(stack, kNumClients, 30, 15, time);
  figures.push_back({"gateway.clients32_cpu_percent", many.cpu_percent, "%", "bare Asio loop",
                     measure_bare_sender(many, 30, 15, time)});
  for (const auto& [share, word] : {std::pair{0.5, "p50"}, {0.9, "p90"}, {0.99, "p99"}}) {
    figures.push_back({std::string("gateway.clients32_state_age_ms.") + word,
                       percentile(many.state_age_ms, share), "ms", "one client",
                       percentile(few.state_age_ms, share)});
  }
  figures.push_back(
      {"gateway.clients32_rate_hz", many.num_states / time / kNumClients, "1/s", "asked for", 30});
  figures.push_back({"gateway.clients32_rss_mib", many.rss_mib, "MiB", "one client", few.rss_mib});

  const nao::DisturbingClients disturbing(stack.tcp_port());
  const Watching disturbed = watch(stack, kNumClients - 3, 30, 15, time);
  const double good_clients = kNumClients - 3;
  figures.push_back({"gateway.disturbed_cpu_percent", disturbed.cpu_percent, "%", "undisturbed",
                     many.cpu_percent});
  figures.push_back({"gateway.disturbed_state_age_ms.p99", percentile(disturbed.state_age_ms, 0.99),
                     "ms", "undisturbed", percentile(many.state_age_ms, 0.99)});
  figures.push_back({"gateway.disturbed_image_age_ms.p95", percentile(disturbed.image_age_ms, 0.95),
                     "ms", "undisturbed", percentile(many.image_age_ms, 0.95)});
  figures.push_back({"gateway.disturbed_rate_hz", disturbed.num_states / time / good_clients, "1/s",
                     "undisturbed", many.num_states / time / kNumClients});
  figures.push_back(
      {"gateway.disturbed_rss_mib", disturbed.rss_mib, "MiB", "undisturbed", many.rss_mib});
}

std::vector<Figure> run(int num_rounds, double time) {
  const std::string lcm_url =
      "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
  Stack stack(lcm_url);
  std::vector<Figure> figures;
  report_ways(stack, num_rounds, figures);
  report_watching(stack, time, figures);
  measure_losses(stack, figures);
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  nao::CommandLine app("Measures the gateway in front of a simulated robot", "nao-bench-gateway");
  std::string json_file;
  int num_rounds = 40;
  double time = 10;
  app.add_option("--json", json_file, "File for the figures as JSON");
  app.add_option("--rounds", num_rounds, "Commands to time on each way")
      ->range(2, 10000)
      ->show_default();
  app.add_option("--time", time, "How long clients watch in each measurement, s")
      ->range(2.0, 3600.0)
      ->show_default();
  if (const auto status = app.parse(argc, argv)) return *status;
  nao::logger::set_up("nao-bench-gateway", "warning");
  // Phones are machines of their own: what they see must not wait for a turn on this one.
  nao::request_realtime_scheduling(nao::RealtimePriority::kControl);
  try {
    nao::report(run(num_rounds, time), json_file);
  } catch (const std::exception& error) {
    nao::logger::error("{}", error.what());
    return 1;
  }
  return 0;
}
