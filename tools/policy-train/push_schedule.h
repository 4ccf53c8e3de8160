#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "common/random.h"

namespace nao::policy_train {

/** How hard the robots of a batch are pushed: near the impulse that a policy withstands half of the
 * time, which it learns for each direction and phase of the gait. Easy pushes teach nothing, and
 * the directions and phases that it withstands least are pushed most.
 *
 * A push to the right is the mirror image of one to the left half a cycle later. */
class PushSchedule {
 public:
  /** @param greatest  Greatest impulse, N s for each kg of the robot. */
  explicit PushSchedule(double greatest);

  struct Push {
    int cell = 0;
    /** Impulse as a fraction of the cell's. */
    double fraction = 0;
    /** N s for each kg; x where the robot looks, y to the left. */
    Eigen::Vector2d impulse = Eigen::Vector2d::Zero();
  };
  /** @param phase  Of the gait, cycles; nothing: the robot stands. */
  Push draw(std::optional<double> phase, Random& random) const;

  /** @param fallen  Whether the push threw the robot over. */
  void learn(const Push& push, bool fallen);

 private:
  // Chosen: a step of a T1 takes three of the phases, and a walk was found to withstand pushes to
  // the next direction up to a quarter better.
  static constexpr int kNumDirections = 5;  // from ahead over the left to back
  static constexpr int kNumPhases = 6;

  static int cell_of(int direction, int phase) { return direction * (kNumPhases + 1) + phase; }

  double greatest_;
  /** Impulse that is withstood half of the time, by direction and phase; the last phase: standing.
   */
  std::array<double, kNumDirections*(kNumPhases + 1)> impulses_;
};

/** The pushes of one robot, one after the other, and how they end. */
class RobotPushes {
 public:
  /** @param schedule  Must outlive this. */
  explicit RobotPushes(const PushSchedule& schedule) : schedule_(&schedule) {}

  /** Forgets a push that is not decided. */
  void begin_episode() { last_.reset(); }
  /** Whether the robot is pushed now: some time after the last push was decided.
   * @param period  Between two questions, s. */
  bool is_due(double period, Random& random) const;
  /** @param phase  See PushSchedule. @param time  In the episode, s.
   * @return The impulse, N s for each kg, see PushSchedule. */
  Eigen::Vector2d push(std::optional<double> phase, double time, Random& random);
  /** Decides whether the last push threw the robot over. */
  void judge(double time, bool fallen);

  struct Outcome {
    PushSchedule::Push push;
    bool fallen = false;
  };
  /** Of a push that was decided when last judged. */
  const std::optional<Outcome>& outcome() const { return outcome_; }

 private:
  const PushSchedule* schedule_;
  /** The last push, until it is decided; and its time in the episode, s. */
  std::optional<PushSchedule::Push> last_;
  double time_ = 0;
  std::optional<Outcome> outcome_;
};

}  // namespace nao::policy_train
