#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace nao::sim {

/** Servo targets of all motors, in motor order. */
struct MotorTargets {
  /** rad (hands: opening). */
  Eigen::VectorXd position;
  /** Fraction of the peak torque that each motor may use, 0 to 1. */
  Eigen::VectorXd stiffness;
  /** Gains of the position servos, N m/rad and N m s/rad; NaN: the motor's own. Both may be empty:
   * all are the motors' own. */
  Eigen::VectorXd kp{};
  Eigen::VectorXd kd{};
};

/** Servo targets that take effect a number of control ticks after they are set. */
class DelayedTargets {
 public:
  DelayedTargets(int num_motors, int latency_ticks) {
    newest_.position = Eigen::VectorXd::Zero(num_motors);
    newest_.stiffness = Eigen::VectorXd::Ones(num_motors);
    ring_.assign(static_cast<size_t>(latency_ticks) + 1, newest_);
  }

  /** Sets the targets that the next tick sends on their way. Allocates nothing. */
  void set(const MotorTargets& targets) {
    newest_.position = targets.position;
    newest_.stiffness = targets.stiffness;
    newest_.kp = targets.kp;
    newest_.kd = targets.kd;
  }
  /** As set last. */
  const MotorTargets& newest() const { return newest_; }
  /** In effect during this tick. */
  const MotorTargets& current() const { return ring_[static_cast<size_t>(tick_) % ring_.size()]; }

  void begin_tick() {
    const size_t latency = ring_.size() - 1;
    ring_[(static_cast<size_t>(tick_) + latency) % ring_.size()] = newest_;
  }
  void end_tick() { ++tick_; }

  /** Targets that are in effect at once, without latency. */
  void set_at_once(const MotorTargets& targets) {
    set(targets);
    std::fill(ring_.begin(), ring_.end(), newest_);
  }

 private:
  MotorTargets newest_;
  /** Targets of the ticks from now on, at index tick modulo the ring's size. */
  std::vector<MotorTargets> ring_;
  int64_t tick_ = 0;
};

}  // namespace nao::sim
