#pragma once

#include <array>
#include <vector>

namespace nao::motion {

/** Measures the time from a joint command to the measured joint angle that follows it: transport of
 * the command, lag of the servos, and transport of the measurement together.
 *
 * For each whole number of control ticks j the squared difference of the joints' increments,
 *
 *     E_j = sum over joints, leaky over time, (dq_measured(t) - dq_commanded(t - j))^2,
 *
 * is compared; the minimum, interpolated by a parabola, is the lag. Increments are free of constant
 * errors of the angles (zero of the encoder, load). While the joints rest, the lag is kept.
 *
 * Memory is allocated once, by the first update(). */
class LagEstimator {
 public:
  /** Restarts. @param lag  Value assumed until the joints have moved enough, s. */
  void start(double lag);

  /** One control tick, before this tick's command is computed.
   * @param commanded  Angles of the last tick's command, without feedback and feedforward, rad.
   * @param measured   Angles now, rad, of the same joints. @param joints  Which of them to compare.
   * @param dt         s since the last tick. */
  void update(const std::vector<double>& commanded, const std::vector<double>& measured,
              const std::vector<int>& joints, double dt);

  /** s. */
  double lag() const { return lag_; }

 private:
  /** Greatest lag that can be measured, in ticks. */
  static constexpr int kMaxTicks = 10;

  void accumulate(const std::vector<double>& moved, double decay);
  void find_minimum(double dt);

  double lag_ = 0;
  bool is_started_ = false;
  /** Increments of the last commands, the newest at newest_, rad, (joints) each. */
  std::array<std::vector<double>, kMaxTicks> commanded_;
  int newest_ = 0;
  std::vector<double> last_commanded_;
  std::vector<double> last_measured_;
  std::vector<double> moved_;
  /** E_j for j = 1 .. kMaxTicks, rad^2, and the same sum of the measured increments alone. */
  std::array<double, kMaxTicks> error_{};
  double motion_ = 0;
};

}  // namespace nao::motion
