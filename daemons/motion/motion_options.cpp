#include "daemons/motion/motion_options.h"

#include <string>

#include "common/error.h"

namespace nao::motion {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw ConfigError(std::string("motion options: ") + what);
}

}  // namespace

void MotionOptions::validate() const {
  require(sensor_timeout > 0, "sensor_timeout must be above 0 s");
  require(max_acceleration > 0, "max_acceleration must be above 0 rad/s^2");
  require(free_acceleration > 0, "free_acceleration must be above 0 rad/s^2");
  require(default_speed > 0 && default_speed <= 1, "default_speed must be above 0 up to 1");
  require(posture_leg_speed > 0 && posture_leg_speed <= 1,
          "posture_leg_speed must be above 0 up to 1");
  require(posture_tolerance > 0, "posture_tolerance must be above 0 rad");
  require(foot_contact_force > 0, "foot_contact_force must be above 0 N");
  require(motion_state_period > 0, "motion_state_period must be above 0 s");
}

}  // namespace nao::motion
