#include "daemons/motion/estimator/dead_foot_sensors.h"

#include "common/constants.h"

namespace nao::motion {
namespace {

// Least fraction of the robot's weight on a foot for its sensors to be judged. Chosen: half of a
// foot's load when both feet carry.
constexpr double kLeastLoad = 0.25;
// Fractions of the foot's load: below the first a sensor reads nothing, above the second it is
// alive, and above the third the others say that it is loaded. Chosen: noise of a sensor is below
// 1 %; equally loaded, a sensor of four has 25 %.
constexpr double kNothing = 0.01;
constexpr double kAlive = 0.05;
constexpr double kImplied = 0.08;
// Time without a reading under load after which a sensor is dead, s. The first is for a sensor that
// has never been loaded; chosen: within the stand before a walk. The second, with no step in
// between, is for one that has been loaded; chosen: longer than a step, which may leave the outer
// edge of a sole without load each time, and than any stand on the edge of a bump.
constexpr double kDeadTime = 0.3;
constexpr double kLostTime = 3;

}  // namespace

DeadFootSensors::DeadFootSensors(const RobotModel& model)
    : pressure_(model),
      least_load_(kLeastLoad * model.total_mass() * kGravity),
      silent_time_(pressure_.num_sensors(), 0.0),
      has_been_loaded_(pressure_.num_sensors(), false),
      is_dead_(pressure_.num_sensors(), false) {}

void DeadFootSensors::update(std::vector<double>& force, double dt) {
  for (size_t i = 0; i < force.size(); ++i) {
    double load = 0;
    for (const int sensor : pressure_.sensors_of_foot(i)) load += force[sensor];
    if (load < least_load_) {
      if (has_been_loaded_[i]) silent_time_[i] = 0;
      continue;
    }
    if (force[i] > kAlive * load) {
      has_been_loaded_[i] = true;
      silent_time_[i] = 0;
      is_dead_[i] = false;
    } else if (force[i] < kNothing * load &&
               pressure_.implied_force(i, force, is_dead_) > kImplied * load) {
      silent_time_[i] += dt;
      if (silent_time_[i] > (has_been_loaded_[i] ? kLostTime : kDeadTime)) is_dead_[i] = true;
    }
  }
  pressure_.replace_dead(is_dead_, force);
}

}  // namespace nao::motion
