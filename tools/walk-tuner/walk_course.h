#pragma once

#include <cstdint>
#include <memory>

#include "daemons/motion/walk/gait.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"

namespace nao {

/** How a gait did on one course. */
struct CourseResult {
  /** Mean over the walks; smaller is better, above 2 for a walk with a fall. */
  double cost = 0;
  int num_walks = 0;
  int num_falls = 0;
};

/** The walks that a gait is judged by: ahead, ahead a bit slower, back, sideways, turning, a curve,
 * a thumb on the joystick (twice), a push (twice); each with a physics, noise and latency of its
 * own.
 *
 * Cost of a walk: 2 to 4 with a fall, the more the sooner; else how much velocity was missed (up to
 * 1), how much the torso shook and how hard the motors worked. */
class WalkCourse {
 public:
  /** @param speed       Share of the model's walk limits that is asked for.
   * @param late_share  Chance in each tick that motion misses it and some more. */
  WalkCourse(std::shared_ptr<const RobotModel> model, SceneFile scene, double speed,
             double late_share)
      : model_(std::move(model)),
        scene_(std::move(scene)),
        speed_(speed),
        late_share_(late_share) {}

  /** @param seed  Of everything drawn by chance. The same seed gives the same course. */
  CourseResult run(const motion::Gait& gait, uint64_t seed) const;

 private:
  std::shared_ptr<const RobotModel> model_;
  SceneFile scene_;
  double speed_;
  double late_share_;
};

}  // namespace nao
