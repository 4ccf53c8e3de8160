#include "daemons/motion/motion_options.h"

#include <sstream>

#include "common/error.h"

namespace nao::motion {
namespace {

void require_positive(double value, const char* name, const char* unit) {
  if (value > 0) return;
  std::ostringstream text;
  text << "motion option " << name << " is " << value << " " << unit << "; it must be above 0";
  throw ConfigError(text.str());
}

void require_fraction(double value, const char* name) {
  if (value > 0 && value <= 1) return;
  std::ostringstream text;
  text << "motion option " << name << " is " << value << ", outside (0, 1]";
  throw ConfigError(text.str());
}

}  // namespace

// Throws for the first option that is out of range; values come from the command line and tools.
void MotionOptions::validate() const {
  require_positive(sensor_timeout, "sensor_timeout", "s");
  require_positive(max_acceleration, "max_acceleration", "rad/s^2");
  require_positive(free_acceleration, "free_acceleration", "rad/s^2");
  require_fraction(default_speed, "default_speed");
  require_fraction(posture_leg_speed, "posture_leg_speed");
  require_positive(posture_tolerance, "posture_tolerance", "rad");
  require_positive(lying_posture_tolerance, "lying_posture_tolerance", "rad");
  require_positive(lying_tilt, "lying_tilt", "rad");
  require_positive(motion_state_period, "motion_state_period", "s");
}

}  // namespace nao::motion
