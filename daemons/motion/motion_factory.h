#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "daemons/motion/actions/action_script.h"
#include "daemons/motion/actions/kick.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/guards/joint_change_guard.h"
#include "daemons/motion/motion_options.h"
#include "daemons/motion/standing_balance.h"
#include "daemons/motion/transitions/transition_graph.h"
#include "daemons/motion/walk/gait.h"
#include "kinematics/leg_kinematics.h"
#include "messages/command.h"
#include "messages/reason.h"
#include "policy/policy.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** A motion that executes a command, or why there is none. */
using MotionPlan = std::variant<std::unique_ptr<MotionGenerator>, Reason>;

/** Makes the motion that executes a command, or refuses it.
 *
 * Owns the motion data of the robot: gait, kick, keyframe actions, transition graph. Actions are a
 * table from name to planner, made from robot.yaml's `actions`. */
class MotionFactory {
 public:
  /** Reads the robot's motion data.
   * @param model, options, guard  Must outlive this.
   * @throws ModelError  if a file is wrong, or the robot has no posture. */
  MotionFactory(const RobotModel& model, const MotionOptions& options, JointChangeGuard& guard);

  // The motions hold pointers to the data.
  MotionFactory(const MotionFactory&) = delete;
  MotionFactory& operator=(const MotionFactory&) = delete;

  /** @param command  Well formed (find_fault()). @param targets  As sent in the last step. */
  MotionPlan plan(const Command& command, const MotionContext& context,
                  const JointTargets& targets);

  /** Makes a taught motion an action of its name; nullptr removes it. The robot's own actions go
   * before taught ones of the same name. */
  void set_taught(const std::string& name, std::shared_ptr<const ActionScript> script);
  bool has_taught(const std::string& name) const { return taught_.contains(name); }

  /** Path to a posture from any state of the body, as exact as it can be. @param speed  Fraction of
   * the maximum, (0, 1]. */
  std::unique_ptr<MotionGenerator> make_posture_path(const Posture& posture, double speed) const;
  /** The same at the speed of the robot's own motions, and only as exact as it needs to stand. */
  std::unique_ptr<MotionGenerator> make_posture_path(const Posture& posture) const;
  /** Path to the posture in which walks and actions begin. */
  std::unique_ptr<MotionGenerator> make_stand_path() const;
  /** The same after a fall. @param num_tries  Get-ups before, after which it fell again at once:
   * another motion is tried. */
  std::unique_ptr<MotionGenerator> make_get_up(int num_tries);

  /** Steps of a standing robot that was pushed, until it stands again; nullptr if it must not step,
   * or need not. @param targets  As sent in the last step. */
  std::unique_ptr<MotionGenerator> make_push_recovery(const MotionContext& context,
                                                      const JointTargets& targets);

  /** A policy that goes on with a walk by the gait whose next step would not catch the robot;
   * nullptr: none, or no such push. @param velocity  Of the walk, see is_walk_pushed(). */
  std::unique_ptr<MotionGenerator> make_walk_recovery(const RobotState& state,
                                                      const Eigen::Vector3d& velocity,
                                                      const WalkCommand& walk);
  /** Whether a policy must catch a robot that stands. */
  bool must_policy_catch(const RobotState& state) const;

  /** Balance of a standing robot with a gait; nothing without. */
  std::optional<StandingBalance> make_standing_balance() const;

  /** The posture in which walks and actions begin. */
  const Posture& stand() const { return *stand_; }

  /** The robot's policies, also those that cannot be used. */
  const std::vector<Policy>& policies() const { return policies_; }

 private:
  /** Command-independent input of a plan. */
  struct Situation {
    const MotionContext& context;
    const JointTargets& targets;
  };
  using ActionPlanner = std::function<MotionPlan(const ActionCommand&, const Situation&)>;

  std::map<std::string, ActionPlanner> make_action_table();
  /** Empty if the robot has no motion for the action. */
  ActionPlanner make_planner(const Action& action);
  /** @param keyframes  Name of an action script or of a transition. */
  ActionPlanner make_keyframe_planner(const std::string& keyframes);

  MotionPlan plan_request(const WalkCommand& walk, const Situation& situation);
  MotionPlan plan_request(const MoveToCommand& move_to, const Situation& situation);
  MotionPlan plan_request(const PostureCommand& posture, const Situation& situation);
  MotionPlan plan_request(const JointChangeCommand& change, const Situation& situation);
  MotionPlan plan_request(const ActionCommand& action, const Situation& situation);
  MotionPlan plan_request(const StopCommand& stop, const Situation& situation);

  MotionPlan plan_policy(const Policy& policy, const Situation& situation);
  /** A motion by a policy. @param command  Of a walk. */
  std::unique_ptr<MotionGenerator> make_policy_motion(const Policy& policy,
                                                      const WalkCommand& command);
  /** Push recovery by the policy, then a walk. */
  std::unique_ptr<MotionGenerator> make_policy_recovery(const WalkCommand& walk) const;
  MotionPlan plan_kick(const ActionCommand& action, const Situation& situation, bool is_left) const;
  MotionPlan plan_script(const ActionScript& script, const Situation& situation) const;
  MotionPlan plan_taught(const std::shared_ptr<const ActionScript>& script,
                         const Situation& situation) const;
  MotionPlan plan_sequence(const KeyframeSequence& sequence, const Situation& situation) const;

  /** Why the robot cannot reach a posture; nothing if it can. */
  std::optional<Reason> find_posture_obstacle(const Posture& goal,
                                              const Situation& situation) const;
  /** The joint that a change would relax although it carries the robot. */
  std::optional<Reason> find_relaxed_support(const JointChangeCommand& change,
                                             const Situation& situation) const;
  /** Why the robot must not walk by its gait; nothing if it may. */
  std::optional<Reason> find_walk_obstacle(const Situation& situation) const;
  /** The same for a walk that goes to its stand first: it may start from a seat. */
  std::optional<Reason> find_obstacle_after_standing_up(const Situation& situation) const;
  /** The same for a policy, which needs no gait; and without standing up, of the legs alone. */
  std::optional<Reason> find_policy_obstacle(const Situation& situation) const;
  std::optional<Reason> find_leg_obstacle(const Situation& situation) const;

  const RobotModel* model_;
  const MotionOptions* options_;
  JointChangeGuard* guard_;
  TransitionGraph graph_;
  /** None for a robot that does not walk, or does not kick. */
  std::optional<Gait> gait_;
  /** Exist with the gait or a policy. */
  std::optional<LegKinematics> legs_;
  std::optional<Kick> kick_;
  std::vector<ActionScript> scripts_;
  const Posture* stand_;
  std::vector<Policy> policies_;
  /** The one that walks, as a robot without a gait does from the start; nullptr: the gait. */
  const Policy* walk_policy_ = nullptr;
  const Policy* get_up_policy_ = nullptr;
  /** Push recovery; nullptr: the gait, if there is one. */
  const Policy* recovery_ = nullptr;
  std::map<std::string, ActionPlanner> actions_;
  std::map<std::string, std::shared_ptr<const ActionScript>> taught_;
};

}  // namespace nao::motion
