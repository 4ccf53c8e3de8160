#pragma once

#include <cstdint>

namespace nao::motion {

/** Keeps to the robot that was heard first, of two that publish on one channel, as when two
 * networks are joined: never obeyed in turns. Their clocks differ, as they started at different
 * times. The other one is heard when the first is silent, or was reset, so that only its new time
 * is heard. */
class SensorOwner {
 public:
  /** @param utime  Robot time of a sensor state, us. @param now  s, monotonic.
   * @return Whether it is the owner's. */
  bool accepts(int64_t utime, double now);

  /** Whether another robot, or the reset one, may become the owner within 0.5 s. */
  bool is_contested(double now) const;

  int64_t num_rejected() const { return num_rejected_; }

 private:
  bool has_owner_ = false;
  /** Time of the owner's last state. */
  int64_t utime_ = 0;
  double time_ = 0;
  /** States of another robot since then. */
  int num_others_ = 0;
  int64_t num_rejected_ = 0;
};

}  // namespace nao::motion
