// nao-simulation-server: simulates one robot, stepped by requests on stdin. README.md

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "common/command_line.h"
#include "common/error.h"
#include "common/program.h"
#include "phone-gateway/protocol/framing.h"
#include "tools/simulation-server/simulation_core.h"

namespace nao::simulation_server {
namespace {

void write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw Error(std::string("cannot write to stdout: ") + std::strerror(errno));
    bytes.remove_prefix(static_cast<size_t>(written));
  }
}

/** Answers the requests on stdin until its end. @throws Error  after a request that is too long. */
void serve(SimulationCore& core) {
  FrameReader reader(kMaxRequestBytes);
  std::array<char, 65536> buffer{};
  for (;;) {
    const ssize_t received = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (received < 0 && errno == EINTR) continue;
    if (received < 0) throw Error(std::string("cannot read stdin: ") + std::strerror(errno));
    if (received == 0) return;
    reader.add({buffer.data(), static_cast<size_t>(received)});
    while (const auto request = reader.next()) write_all(frame(core.handle(*request)));
    if (reader.is_oversized()) {
      const std::string reason =
          "a request is longer than " + std::to_string(kMaxRequestBytes) + " bytes";
      protocol::Response response;
      response.set_error(reason);
      write_all(frame(response.SerializeAsString()));
      throw Error(reason);
    }
  }
}

}  // namespace
}  // namespace nao::simulation_server

int main(int argc, char** argv) {
  using namespace nao::simulation_server;
  nao::CommandLine app(
      "Simulates one robot with its motion core, stepped in lock-step by the requests of "
      "simulation.proto on stdin, each after its length (4 bytes, big-endian); the responses go to "
      "stdout. No bus, no clock.",
      "nao-simulation-server");
  nao::CommonOptions common;
  common.log_level = "warning";
  nao::add_log_option(app, common);
  std::string model = "nao";
  std::string scene = "empty";
  std::string disturbances = "default";
  nao::ClosedLoopOptions options;
  nao::add_model_option(app, model);
  app.add_option("--scene", scene, "Name of a file in scenes/");
  app.add_option("--engine", options.engine,
                 "Physics engine: fast, simbody, or mujoco where it was built");
  app.add_option(
      "--disturbances", disturbances,
      "Disturbances to draw for each seed: none, default, moderate, real, or entries of real "
      "such as backlash,floor_slope");
  app.add_option("--tick-ms", options.tick_ms,
                 "Control period, ms: a multiple of 2 (0: as the disturbances say, or 10)");
  return nao::run_program(app, common, argc, argv, [&] {
    options.model = std::make_shared<nao::RobotModel>(nao::RobotModel::find(model));
    options.scene = nao::SceneFile::find(scene);
    options.disturbances =
        std::make_shared<nao::sim::DisturbanceSet>(nao::sim::DisturbanceSet::find(disturbances));
    SimulationCore core(std::move(options));
    serve(core);
  });
}
