#include "daemons/robot/take_over.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <utility>

#include "common/wall_clock.h"
#include "daemons/robot/robot_core.h"
#include "lola/socket.h"

namespace nao::robot {
namespace {

/** After the end of a connection LoLA may send a broken message first, s: B-Human waits as long. */
constexpr double kPauseTime = 0.1;
/** Time allowed to connect, and for everything, s. Chosen: the robot sits down in 3 s. */
constexpr double kConnectTime = 1;
constexpr double kTotalTime = 10;
/** Wait between attempts and for frames, ms. */
constexpr int kPollMs = 20;

// This has no event loop: it runs after nao-robot has died, with as little code as possible.
void sleep_for(double seconds) {
  usleep(static_cast<useconds_t>(seconds * 1e6));
}

std::optional<UnixSocket> connect(const std::string& path) {
  const double end = monotonic_seconds() + kConnectTime;
  sleep_for(kPauseTime);
  while (monotonic_seconds() < end) {
    if (auto socket = UnixSocket::connect(path)) return socket;
    sleep_for(kPollMs * 1e-3);
  }
  return std::nullopt;
}

}  // namespace

std::string take_over(const RobotModel& model, const std::string& lola_socket) {
  auto socket = connect(lola_socket);
  if (!socket) return "no LoLA at " + lola_socket + "; nothing to do";
  LolaConnection<LolaState> connection(std::move(*socket));
  const LolaMap map = LolaMap::load(model);
  RobotCore core(model, map, false);
  LolaState state;
  const double end = monotonic_seconds() + kTotalTime;
  bool has_state = false;
  while (monotonic_seconds() < end && connection.end().empty()) {
    pollfd polled{connection.descriptor(), POLLIN, 0};
    poll(&polled, 1, kPollMs);
    connection.receive();
    while (connection.next(state)) {
      core.take_frame(state, has_state ? 1 : 0);
      has_state = true;
      std::array<uint8_t, kLolaCommandBytes> bytes;
      // Without a command or driver, and with a request to end, Safety makes the robot sit down and
      // go limp.
      const LolaCommand& command = core.step({nullptr, false, true});
      connection.send(std::span(bytes).first(encode(command, bytes)));
      if (core.safety().phase() != Phase::kEnded) continue;
      return core.safety().cause() == Cause::kFoundStiff ? "the robot was stiff and has sat down"
                                                         : "the robot is limp";
    }
  }
  return connection.end().empty() ? "LoLA sends no frames" : "LoLA: " + connection.end();
}

}  // namespace nao::robot
