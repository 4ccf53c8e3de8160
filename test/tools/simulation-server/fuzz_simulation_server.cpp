// Input of libFuzzer: bytes on the stdin of nao-simulation-server. The first byte is the size of
// the pieces in which the others arrive, minus one. The world is kept from one input to the next:
// making a new one takes longer than a thousand requests.
#include <google/protobuf/stubs/logging.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include "common/data_path.h"
#include "phone-gateway/protocol/framing.h"
#include "tools/simulation-server/simulation_core.h"

namespace {

namespace server = nao::simulation_server;

std::unique_ptr<server::SimulationCore> make_core() {
  nao::ClosedLoopOptions options;
  options.model = std::make_shared<const nao::RobotModel>(
      nao::RobotModel::load(nao::data_path() / "robots" / "nao"));
  auto core = std::make_unique<server::SimulationCore>(options);
  server::protocol::Request reset;
  reset.mutable_reset()->set_seed(1);
  core->handle(reset);
  return core;
}

/** A request that takes little time: few ticks, no new world. */
std::string shortened(std::string bytes) {
  server::protocol::Request request;
  if (!request.ParseFromString(bytes)) return bytes;
  if (request.has_reset()) request.mutable_reset()->set_posture("none of the robot's");
  if (request.has_step() && request.step().num_ticks() > 2)
    request.mutable_step()->set_num_ticks(2);
  return request.SerializeAsString();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  // It reports every text that is not UTF-8.
  google::protobuf::SetLogHandler(nullptr);
  static const std::unique_ptr<server::SimulationCore> core = make_core();
  if (size == 0) return 0;
  const size_t piece = size_t{1} + data[0];
  const std::string_view stream(reinterpret_cast<const char*>(data) + 1, size - 1);
  nao::FrameReader reader(server::kMaxRequestBytes);
  for (size_t start = 0; start < stream.size(); start += piece) {
    reader.add(stream.substr(start, piece));
    while (const auto request = reader.next()) {
      server::protocol::Response response;
      if (!response.ParseFromString(core->handle(shortened(std::string(*request))))) std::abort();
      if (response.response_case() == server::protocol::Response::RESPONSE_NOT_SET) std::abort();
      for (const double value : response.state().joint_position()) {
        if (!std::isfinite(value)) std::abort();
      }
    }
  }
  return 0;
}
