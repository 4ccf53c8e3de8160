#include "daemons/motion/sensor_owner.h"

namespace nao::motion {
namespace {

// Robot time between two states of one robot, us. Chosen: more than lost messages and a busy host
// make of it.
constexpr int64_t kMaxStep = 2'000'000;
// Silence after which the owner has ended, s, and states of another robot without one of the owner
// after which it was reset. Chosen: below the 0.5 s after which there is no robot, and more states
// than another robot sends between two of an owner at rest.
constexpr double kSilence = 0.25;
constexpr int kMinOthers = 12;

}  // namespace

bool SensorOwner::accepts(int64_t utime, double now) {
  const bool is_owner = utime >= utime_ && utime - utime_ <= kMaxStep;
  if (has_owner_ && !is_owner && now - time_ < kSilence && ++num_others_ < kMinOthers) {
    ++num_rejected_;
    return false;
  }
  has_owner_ = true;
  utime_ = utime;
  time_ = now;
  num_others_ = 0;
  return true;
}

bool SensorOwner::is_contested(double now) const {
  return num_others_ > 0 && now - time_ < 2 * kSilence;
}

}  // namespace nao::motion
