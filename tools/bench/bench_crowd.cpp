// Measures one gateway in front of 8 robots: what 8 drivers and 92 spectators cost, and whether the
// spectators, or 1000 connection attempts a second without the token, delay the drivers' commands.
// The robots are messages of this program: no simulator takes part.

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <naolcm/image_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <stdexcept>
#include <thread>

#include "common/bus.h"
#include "common/channels.h"
#include "common/child_process.h"
#include "common/scheduling.h"
#include "common/wall_clock.h"
#include "phone-gateway/protocol/framing.h"
#include "tools/bench/deadline.h"
#include "tools/bench/ports.h"
#include "tools/bench/run_benchmark.h"
#include "tools/bench/wire_client.h"

namespace nao::bench {
namespace {

/** A hundred clients: a phone for each of eight robots, and spectators. */
constexpr int kNumDrivers = 8;
constexpr int kNumSpectators = 92;
/** Rates of a driver's phone, and of a spectator's, 1/s. */
constexpr double kDriverStates = 60;
constexpr double kDriverImages = 15;
constexpr double kSpectatorStates = 10;
constexpr double kSpectatorImages = 5;
/** Camera that shows the whole field. */
const char* const kOverview = "overview";
/** Control ticks from one image of it to the next. */
constexpr int kOverviewTicks = 20;
/** Period of a held joystick's walk requests, s. */
constexpr double kWalkPeriod = 0.1;
/** Bytes of an image: as the camera's of 320 pixels. */
constexpr int kImageBytes = 7000;
/** Connection attempts, 1/s. */
constexpr int kAttemptRate = 1000;

std::string robot_name(int robot) {
  return "CROWD" + std::to_string(robot + 1);
}

/** The messages of one robot, and the walk commands that it receives. */
class FakeRobot {
 public:
  FakeRobot(Bus& bus, int robot) : bus_(bus), channels_(robot_name(robot)) {
    motion_.mode = motion_.MODE_HOLDING;
    motion_.command_kind = motion_.COMMAND_KIND_NONE;
    motion_.posture = "Stand";
    motion_.stiffness = 1;
    image_.width = 320;
    image_.height = 240;
    image_.format = "jpeg";
    image_.size_bytes = kImageBytes;
    image_.data.assign(kImageBytes, 0x5a);
    bus_.subscribe<naolcm::walk_command_t>(
        channels_.walk_command, Bus::Queue::kAll, [this](const auto& command) {
          const auto sent = sent_.find(std::lround(command.vx * 1e6));
          if (sent == sent_.end()) return;
          latency_ms.push_back((monotonic_seconds() - sent->second) * 1e3);
          sent_.erase(sent);
        });
  }

  void set_joints(const naoremote::RobotDescription& robot) {
    state_.joint_names.clear();
    for (const auto& joint : robot.joints()) state_.joint_names.push_back(joint.name());
    state_.num_joints = static_cast<int32_t>(state_.joint_names.size());
    state_.joint_position.assign(state_.joint_names.size(), 0);
    state_.joint_velocity.assign(state_.joint_names.size(), 0);
  }

  /** @param tick  Number of this control tick of 10 ms. */
  void send(int64_t tick) {
    state_.utime = motion_.utime = image_.utime = tick * 10000;
    state_.tick = tick;
    state_.position_torso_in_odometry[2] = 0.3;
    state_.orientation_torso_in_odometry[0] = 1;
    bus_.publish(channels_.robot_state, state_);
    if (tick % 10 == 0) bus_.publish(channels_.motion_state, motion_);
    if (tick % 7 == 0) send_image("top");
  }

  /** Sends an image of a camera; of the overview as the first robot's program does. */
  void send_image(const std::string& camera) {
    image_.camera = camera;
    bus_.publish(channels_.head_camera_image, image_);
  }

  /** A walk at a unique velocity, by which it is recognized on the bus. */
  naoremote::Request next_walk() {
    // 0.01 to 0.1 m/s in steps of 1e-6 m/s, which every gait can do.
    const long velocity = 10000 + next_velocity_++ % 90000;
    naoremote::Request request;
    request.mutable_walk_turn()->set_vx(static_cast<double>(velocity) * 1e-6);
    sent_[velocity] = monotonic_seconds();
    return request;
  }

  std::vector<double> latency_ms;

 private:
  Bus& bus_;
  RobotChannels channels_;
  naolcm::robot_state_t state_{};
  naolcm::motion_state_t motion_{};
  naolcm::image_t image_{};
  long next_velocity_ = 0;
  /** When a velocity, 1e-6 m/s, was sent, s. */
  std::map<long, double> sent_;
};

/** The gateway, the robots and the clients. */
class Crowd {
 public:
  explicit Crowd(const std::string& lcm_url) : bus_(lcm_url) {
    std::vector<std::string> command = {program_folder() + "/nao-phone-gateway",
                                        "--lcm-url",
                                        lcm_url,
                                        "--bind",
                                        "127.0.0.1",
                                        "--http-port",
                                        "0",
                                        "--tcp-port",
                                        "0",
                                        "--overview"};
    for (int i = 0; i < kNumDrivers; ++i) {
      command.insert(command.end(), {"--robot", robot_name(i)});
      robots_.push_back(std::make_unique<FakeRobot>(bus_, i));
    }
    gateway_ = std::make_unique<ChildProcess>(command);
    http_port_ = wait_for_port(*gateway_, "WebSocket on ");
    tcp_port_ = wait_for_port(*gateway_, "TCP on ");
    for (int i = 0; i < kNumDrivers; ++i) add_client(i, kDriverStates, kDriverImages, "top");
    run_until([this] { return num_connected_ == kNumDrivers; }, "all drivers are connected");
    run_for(1);
    naoremote::Request request;
    request.mutable_take_control();
    for (int i = 0; i < kNumDrivers; ++i) clients_[static_cast<size_t>(i)].wire->send(request);
    is_driving_ = true;
    run_for(1);
  }

  uint16_t tcp_port() const { return tcp_port_; }
  const ChildProcess& gateway() const { return *gateway_; }

  void add_spectators() {
    for (int i = 0; i < kNumSpectators; ++i) {
      add_client(i % kNumDrivers, kSpectatorStates, kSpectatorImages, kOverview);
      run_for(0.02);
    }
    run_until([this] { return num_connected_ == kNumDrivers + kNumSpectators; },
              "all spectators are connected");
    run_for(1);
  }

  /** Results of the drivers and the gateway over some seconds. */
  struct Measurement {
    std::vector<double> latency_ms;
    double cpu_percent = 0;
    double states_per_second = 0;
    double images_per_second = 0;
  };

  Measurement measure(double time) {
    for (const auto& robot : robots_) robot->latency_ms.clear();
    num_states_ = num_images_ = 0;
    const double cpu_before = gateway_->cpu_seconds();
    const double start = monotonic_seconds();
    run_for(time);
    const double elapsed = monotonic_seconds() - start;
    Measurement measured;
    measured.cpu_percent = (gateway_->cpu_seconds() - cpu_before) / elapsed * 100;
    measured.states_per_second = num_states_ / elapsed;
    measured.images_per_second = num_images_ / elapsed;
    for (const auto& robot : robots_) {
      measured.latency_ms.insert(measured.latency_ms.end(), robot->latency_ms.begin(),
                                 robot->latency_ms.end());
    }
    return measured;
  }

 private:
  struct Client {
    std::unique_ptr<WireClient> wire;
    double next_ping = 0;
  };

  void add_client(int robot, double state_rate, double image_rate, const std::string& camera) {
    // Half of them over WebSocket, as phones.
    const bool is_websocket = clients_.size() % 2 == 1;
    Client client{is_websocket ? connect_websocket(http_port_) : connect_tcp(tcp_port_)};
    naoremote::Request request;
    request.mutable_connect()->set_protocol_version(1);
    request.mutable_connect()->set_robot(robot_name(robot));
    client.wire->send(request);
    request.mutable_subscribe()->set_state_rate(state_rate);
    request.mutable_subscribe()->set_image_rate(image_rate);
    request.mutable_subscribe()->mutable_image()->set_camera(camera);
    client.wire->send(request);
    clients_.push_back(std::move(client));
  }

  void run_for(double time) {
    const double end = monotonic_seconds() + time;
    while (monotonic_seconds() < end) step();
  }

  void run_until(const std::function<bool()>& is_done, const std::string& what) {
    const double deadline = monotonic_seconds() + kDeadline;
    while (!is_done()) {
      if (monotonic_seconds() > deadline) throw std::runtime_error("timed out before " + what);
      step();
    }
  }

  /** Sends due messages and handles received ones, for about a millisecond. */
  void step() {
    send_due(monotonic_seconds());
    std::vector<pollfd> polled = {{bus_.descriptor(), POLLIN, 0}};
    for (const Client& client : clients_) polled.push_back({client.wire->descriptor(), POLLIN, 0});
    poll(polled.data(), polled.size(), 1);
    // The commands come first, since their time of arrival is measured.
    if (polled[0].revents != 0) bus_.handle();
    for (size_t i = 1; i < polled.size(); ++i) {
      if (polled[i].revents == 0) continue;
      clients_[i - 1].wire->read();
      for (const auto& message : clients_[i - 1].wire->take_messages()) handle(message);
    }
  }

  void handle(const naoremote::ServerMessage& message) {
    num_states_ += message.has_state() ? 1 : 0;
    num_images_ += message.has_image() ? 1 : 0;
    if (!message.has_response()) return;
    const naoremote::Response& response = message.response();
    if (response.error() != naoremote::OK && response.error() != naoremote::ROBOT_UNAVAILABLE) {
      throw std::runtime_error("refused: " + response.message());
    }
    if (!response.has_connected()) return;
    ++num_connected_;
    for (const auto& robot : robots_) robot->set_joints(response.connected().robot());
  }

  void send_due(double now) {
    if (now >= next_tick_) {
      next_tick_ = std::max(next_tick_ + 0.01, now);
      ++tick_;
      for (const auto& robot : robots_) robot->send(tick_);
      if (tick_ % kOverviewTicks == 0) robots_.front()->send_image(kOverview);
    }
    for (size_t i = 0; i < clients_.size(); ++i) {
      Client& client = clients_[i];
      const bool drives = is_driving_ && i < kNumDrivers;
      if (now < client.next_ping) continue;
      // The joysticks are not in step.
      const double phase = static_cast<double>(i) / kNumDrivers * kWalkPeriod;
      client.next_ping = client.next_ping == 0 ? now + phase : now + (drives ? kWalkPeriod : 1);
      naoremote::Request ping;
      ping.mutable_ping();
      client.wire->send(drives ? robots_[i]->next_walk() : ping);
    }
  }

  Bus bus_;
  std::vector<std::unique_ptr<FakeRobot>> robots_;
  std::unique_ptr<ChildProcess> gateway_;
  std::vector<Client> clients_;
  uint16_t http_port_ = 0;
  uint16_t tcp_port_ = 0;
  int num_connected_ = 0;
  bool is_driving_ = false;
  int64_t tick_ = 0;
  double next_tick_ = 0;
  double num_states_ = 0;
  double num_images_ = 0;
};

/** Connects repeatedly with a wrong token, in its own thread. */
class Attempts {
 public:
  explicit Attempts(uint16_t port) : thread_([this, port] { run(port); }) {}
  ~Attempts() {
    is_ending_ = true;
    thread_.join();
  }
  Attempts(const Attempts&) = delete;
  Attempts& operator=(const Attempts&) = delete;

  int64_t num() const { return num_; }

 private:
  void run(uint16_t port) {
    naoremote::Request request;
    request.mutable_connect()->set_protocol_version(1);
    request.mutable_connect()->set_token("guess");
    const std::string bytes = frame(request.SerializeAsString());
    std::deque<int> open;
    auto next = std::chrono::steady_clock::now();
    while (!is_ending_) {
      next += std::chrono::microseconds(1000000 / kAttemptRate);
      std::this_thread::sleep_until(next);
      open.push_back(connect_to_own_host(port));
      (void)!::send(open.back(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      ++num_;
      // The gateway has closed it by now.
      if (open.size() <= kAttemptRate / 10) continue;
      close(open.front());
      open.pop_front();
    }
    for (const int descriptor : open) close(descriptor);
  }

  std::atomic<bool> is_ending_ = false;
  std::atomic<int64_t> num_ = 0;
  std::thread thread_;
};

void add(const std::string& name, const Crowd::Measurement& measured,
         const Crowd::Measurement& alone, std::vector<Figure>& figures) {
  figures.push_back(
      {name + "_cpu_percent", measured.cpu_percent, "%", "8 drivers alone", alone.cpu_percent});
  for (const auto& [share, word] : {std::pair{0.5, "p50"}, {0.99, "p99"}}) {
    figures.push_back({name + "_command_ms." + word, percentile(measured.latency_ms, share), "ms",
                       "8 drivers alone", percentile(alone.latency_ms, share)});
  }
}

std::vector<Figure> run(double time) {
  Crowd crowd("udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0");
  const Crowd::Measurement alone = crowd.measure(time);
  crowd.add_spectators();
  const Crowd::Measurement all = crowd.measure(time);
  std::vector<Figure> figures;
  add("gateway.clients100", all, alone, figures);
  figures.push_back({"gateway.clients100_state_rate_hz", all.states_per_second, "1/s", "asked for",
                     kNumDrivers * kDriverStates + kNumSpectators * kSpectatorStates});
  figures.push_back({"gateway.clients100_image_rate_hz", all.images_per_second, "1/s", "", 0});
  figures.push_back({"gateway.clients100_rss_mib", crowd.gateway().rss_mib(), "MiB", "", 0});
  const Attempts attempts(crowd.tcp_port());
  const int64_t num_before = attempts.num();
  const Crowd::Measurement attacked = crowd.measure(time);
  add("gateway.attempts1000", attacked, alone, figures);
  figures.push_back({"gateway.attempts1000_rate_hz",
                     static_cast<double>(attempts.num() - num_before) / time, "1/s", "asked for",
                     kAttemptRate});
  return figures;
}

}  // namespace
}  // namespace nao::bench

int main(int argc, char** argv) {
  nao::CommandLine app("Measures one gateway with 8 robots and 100 clients", "nao-bench-crowd");
  double time = 10;
  app.add_option("--time", time, "How long each measurement takes, s")->range(2.0, 3600.0);
  return nao::run_benchmark(app, argc, argv, [&] {
    // Phones are machines of their own: what they see must not wait for the processor of this one.
    nao::request_realtime_scheduling(nao::RealtimePriority::kControl);
    return nao::bench::run(time);
  });
}
