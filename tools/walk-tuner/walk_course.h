#pragma once

#include <cstdint>
#include <memory>

#include "daemons/motion/walk/gait.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"

namespace nao::tool {

/** Result of a gait on one course. */
struct CourseResult {
  /** Mean cost of the walks, >= 0; above 2 for a walk with a fall. */
  double cost = 0;
  int num_walks = 0;
  int num_falls = 0;
};

/** Simulated walks that a gait is evaluated by: forward, forward at 60 %, backward, sideways,
 * turning, a curve, random velocities as from a joystick (twice), a push (twice). Each has its own
 * friction, mass, noise and latency.
 *
 * Cost of a walk with a fall: 2 to 4, more for an earlier fall. Else the sum of
 *   relative velocity error, up to 1;
 *   RMS of the torso's roll and pitch rate, 0.5 s/rad, up to 0.5;
 *   sum over the motors of the mean squared torque relative to the peak torque, times 0.2, up to
 *   0.4. */
class WalkCourse {
 public:
  /** @param speed             Fraction of the model's walk limits that is commanded.
   * @param late_probability  That the motion core misses a tick and up to three more. */
  WalkCourse(std::shared_ptr<const RobotModel> model, SceneFile scene, double speed,
             double late_probability)
      : model_(std::move(model)),
        scene_(std::move(scene)),
        speed_(speed),
        late_probability_(late_probability) {}

  /** @param seed  Of all random numbers; equal seeds give equal courses. */
  CourseResult run(const motion::Gait& gait, uint64_t seed) const;

 private:
  std::shared_ptr<const RobotModel> model_;
  SceneFile scene_;
  double speed_;
  double late_probability_;
};

}  // namespace nao::tool
