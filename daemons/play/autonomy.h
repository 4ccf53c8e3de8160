#pragma once

#include <cstdint>
#include <optional>

namespace nao::play {

/** Conditions that decide whether a robot plays by itself. */
struct AutonomyInput {
  /** A match has begun and has not ended. */
  bool is_match_on = false;
  /** The robot's state is known. */
  bool has_robot = false;
  /** A behavior runs; and whether the last one was started by Autonomy. */
  bool is_active = false;
  bool is_own = false;
};

/** Starts the behavior of a match by itself, unless another sender commands the robot. A robot that
 * another sender has commanded during a match waits until it is released: a driver who has fallen
 * silent may stand beside it. Times are monotonic, s. */
class Autonomy {
 public:
  /** @param first_id  Less than the ids of its commands. */
  Autonomy(bool is_enabled, int64_t first_id);

  /** Takes another sender's command. Before a match it only delays the robot: nobody can be
   * surprised by what the whistle begins. */
  void note_other_command(double now);
  /** The robot may play by itself again. */
  void release() { waits_ = false; }
  /** Another sender has commanded the robot, which has not been released since. */
  bool waits_for_release() const { return waits_; }
  /** @return The id of the play command to send now, if one is due: a new id to begin, the same to
   * continue. */
  std::optional<int64_t> step(const AutonomyInput& input, double now);

 private:
  bool is_enabled_;
  int64_t id_;
  bool is_match_on_ = false;
  bool waits_ = false;
  double last_other_ = -1e9;
  double last_request_ = -1e9;
};

}  // namespace nao::play
