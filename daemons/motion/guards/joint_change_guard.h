#pragma once

#include <optional>
#include <vector>

#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/guards/self_collision_guard.h"
#include "daemons/motion/guards/tipping_guard.h"
#include "messages/command.h"
#include "messages/reason.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Predicts whether a change of single joints would make the robot collide with itself or tip over.
 */
class JointChangeGuard {
 public:
  /** @param model  Must outlive this. */
  explicit JointChangeGuard(const RobotModel& model)
      : model_(&model), tipping_guard_(model), collision_guard_(model) {}

  /** Checks for self-collision and, if the robot is on its feet and the command does not allow it,
   * for tipping over. @param change  Well formed (find_fault()). @param targets  That it starts
   * from.
   * @return "self-collision" or "tipping-...", with how far the joint may turn; nothing if the
   * change is safe. */
  std::optional<Reason> find_danger(const JointChangeCommand& change, const MotionContext& context,
                                    const JointTargets& targets);

  /** Checks for self-collision alone. */
  std::optional<Reason> find_self_collision(const JointChangeCommand& change,
                                            const MotionContext& context,
                                            const JointTargets& targets);

 private:
  std::optional<Reason> find_tipping(const JointChangeCommand& change, const MotionContext& context,
                                     const JointTargets& targets);
  /** Finds the joint, among those that a change names, that tilts the body over its feet most. */
  int find_tipping_motor(const JointChangeCommand& change, const MotionContext& context,
                         const std::vector<double>& from, const std::vector<double>& to) const;

  const RobotModel* model_;
  TippingGuard tipping_guard_;
  SelfCollisionGuard collision_guard_;
};

}  // namespace nao::motion
