#pragma once

#include "sim/closed_loop/closed_loop.h"
#include "simulation.pb.h"

/** Conversions between the messages of simulation.proto and the closed loop's types. */
namespace nao::simulation_server {

/** Writes joints, postures, actions, sensors and limits. */
void write_description(const RobotModel& model, naoremote::simulation::Description& description);

/** Sends a command to the motion core. The core checks its values and answers with a result.
 * @return The command's number. */
int64_t send_command(const naoremote::simulation::Command& command, ClosedLoop& loop);

/** Writes sensor readings and the motion core's estimate. */
void write_state(ClosedLoop& loop, naoremote::simulation::State& state);
void write_result(const CommandResult& result, naoremote::simulation::CommandResult& message);
/** Writes the truth, which no robot knows. */
void write_truth(ClosedLoop& loop, naoremote::simulation::Truth& truth);

}  // namespace nao::simulation_server
