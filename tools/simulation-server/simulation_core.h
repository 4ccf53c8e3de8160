#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "sim/closed_loop/closed_loop.h"
#include "simulation.pb.h"

namespace nao::simulation_server {

namespace protocol = naoremote::simulation;

/** Largest request, bytes. Chosen: far more than a step with targets for all joints needs. */
inline constexpr size_t kMaxRequestBytes = 65536;
/** Most ticks of one step: a minute of simulated time, so that a response comes within seconds. */
inline constexpr uint32_t kMaxTicks = 6000;
/** Most commands of one step. Chosen: more than a robot has motions to combine. */
inline constexpr int kMaxCommands = 64;

/** One simulated robot, stepped by requests of simulation.proto.
 *
 * No clock, file or socket: the same requests give the same responses, bit for bit. */
class SimulationCore {
 public:
  /** @param options  Options of every world; the posture is that of each Reset. */
  explicit SimulationCore(ClosedLoopOptions options);
  SimulationCore(const SimulationCore&) = delete;
  SimulationCore& operator=(const SimulationCore&) = delete;

  /** Answers a request in bytes; any bytes are answered. */
  std::string handle(std::string_view request);
  /** Answers a request. */
  protocol::Response handle(const protocol::Request& request);

 private:
  void describe(protocol::Description& description) const;
  void reset(const protocol::Reset& request, protocol::State& state);
  void step(const protocol::Step& request, protocol::State& state);
  void set_joint_targets(const protocol::JointTargets& targets);
  void write_state(bool with_truth, protocol::State& state);

  ClosedLoopOptions options_;
  std::unique_ptr<ClosedLoop> loop_;
  /** Servo targets of the present step; valid while has_targets_. */
  sim::MotorTargets targets_;
  bool has_targets_ = false;
};

}  // namespace nao::simulation_server
