#include "daemons/motion/motion_factory.h"

#include <filesystem>
#include <utility>

#include "common/error.h"
#include "daemons/motion/actions/taught_script.h"
#include "daemons/motion/generators/joint_change_motion.h"
#include "daemons/motion/generators/kick_motion.h"
#include "daemons/motion/generators/policy_motion.h"
#include "daemons/motion/generators/posture_path_motion.h"
#include "daemons/motion/generators/rest_motion.h"
#include "daemons/motion/generators/script_motion.h"
#include "daemons/motion/generators/sequence_motion.h"
#include "daemons/motion/generators/taught_motion.h"
#include "daemons/motion/generators/walk_motion.h"
#include "daemons/motion/push_recovery.h"
#include "daemons/motion/standing_rates.h"
#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

constexpr const char* kTransitionFile = "transitions.yaml";
constexpr const char* kGaitFile = "gait.yaml";
constexpr const char* kScriptFile = "actions/keeper.yaml";

// nao-transition-tuner provides its own transitions; otherwise they come from the robot's file.
TransitionGraph load_graph(const RobotModel& model, const MotionOptions& options) {
  if (options.transitions) return *options.transitions;
  return TransitionGraph::load(model, model.folder() / kTransitionFile);
}

// Stiffness below which a joint cannot carry the robot. Chosen: the value up to which walking is
// refused.
constexpr double kCarryingStiffness = 0.6;

/** @throws ConfigError  if there is no policy of that name that walks. One that cannot be used is
 * refused when it shall walk. */
const Policy& find_policy(const std::vector<Policy>& policies, const std::string& name) {
  std::string known;
  for (const Policy& policy : policies) {
    if (policy.name == name) {
      if (policy.manifest && policy.manifest->kind == PolicyManifest::Kind::kAction) {
        throw ConfigError("the policy " + name + " is an action; start it as one");
      }
      return policy;
    }
    known += (known.empty() ? "" : ", ") + policy.name;
  }
  throw ConfigError("the robot has no policy " + name + "; it has " +
                    (known.empty() ? "none" : known));
}

/** The first policy that can be used and whose manifest fits; nullptr: none. */
template <class Fits>
const Policy* find_policy(const std::vector<Policy>& policies, Fits fits) {
  const auto found = std::ranges::find_if(policies, [&](const Policy& policy) {
    return policy.fault.empty() && fits(*policy.manifest);
  });
  return found == policies.end() ? nullptr : &*found;
}

/** A state of the body as an argument of a reason. */
std::string name_of(const std::string& body_state) {
  return body_state.empty() ? "unknown" : body_state;
}

}  // namespace

MotionFactory::MotionFactory(const RobotModel& model, const MotionOptions& options,
                             JointChangeGuard& guard)
    : model_(&model),
      options_(&options),
      guard_(&guard),
      graph_(load_graph(model, options)),
      gait_(options.gait),
      stand_(&model.ready_posture()) {
  const std::filesystem::path& folder = model.folder();
  // A robot without gait, kick or scripts is controlled without these; its commands are refused.
  if (!gait_ && std::filesystem::exists(folder / kGaitFile)) gait_ = Gait::load(folder / kGaitFile);
  policies_ = load_policies(model);
  recovery_ = find_policy(policies_, [](const PolicyManifest& manifest) {
    return manifest.recovery_margin.has_value();
  });
  if (gait_ || !policies_.empty()) legs_.emplace(model);
  get_up_policy_ = find_policy(policies_, [](const PolicyManifest& manifest) {
    return manifest.kind == PolicyManifest::Kind::kGetUp;
  });
  if (options.policy == kNoPolicy) {
    get_up_policy_ = nullptr;
  } else if (!options.policy.empty()) {
    const Policy& policy = find_policy(policies_, options.policy);
    const bool gets_up = policy.manifest && policy.manifest->kind == PolicyManifest::Kind::kGetUp;
    (gets_up ? get_up_policy_ : walk_policy_) = &policy;
  }
  if (walk_policy_ == nullptr && !gait_) {
    walk_policy_ = find_policy(policies_, [](const PolicyManifest& manifest) {
      return manifest.kind == PolicyManifest::Kind::kWalk && !manifest.recovery_margin;
    });
  }
  if (std::filesystem::exists(folder / kKickFile)) kick_ = Kick::load(folder / kKickFile);
  if (std::filesystem::exists(folder / kScriptFile)) {
    scripts_ = ActionScript::load(model, folder / kScriptFile);
  }
  actions_ = make_action_table();
}

std::map<std::string, MotionFactory::ActionPlanner> MotionFactory::make_action_table() {
  std::map<std::string, ActionPlanner> table;
  // Actions of robot.yaml without a motion are left out: "action-without-motion" is the answer.
  for (const Action& action : model_->actions()) {
    if (ActionPlanner planner = make_planner(action)) table[action.name] = std::move(planner);
  }
  return table;
}

// The motion that carries out an action; nullptr if the robot's files do not have it.
MotionFactory::ActionPlanner MotionFactory::make_planner(const Action& action) {
  switch (action.kind) {
    case Action::Kind::kStandUp:
      return [this](const ActionCommand&, const Situation& situation) -> MotionPlan {
        const bool lies = is_lying(situation.context.state, options_->lying_tilt);
        return lies ? make_get_up(0) : make_stand_path();
      };
    case Action::Kind::kRest:
      return [this](const ActionCommand&, const Situation&) -> MotionPlan {
        return std::make_unique<RestMotion>(
            graph_, *model_->find_posture(model_->references().rest), options_->default_speed);
      };
    case Action::Kind::kKick:
      return [this, is_left = action.side == Side::kLeft](const ActionCommand& command,
                                                          const Situation& situation) {
        return plan_kick(command, situation, is_left);
      };
    case Action::Kind::kPolicy:
      for (const Policy& policy : policies_) {
        if (policy.name != action.name) continue;
        return [this, &policy](const ActionCommand&, const Situation& situation) {
          return plan_policy(policy, situation);
        };
      }
      return nullptr;
    case Action::Kind::kOwnGait:
      return [this](const ActionCommand&, const Situation&) -> MotionPlan {
        walk_policy_ = nullptr;
        return std::make_unique<StopMotion>();
      };
    default:
      return make_keyframe_planner(action.keyframes);
  }
}

MotionFactory::ActionPlanner MotionFactory::make_keyframe_planner(const std::string& keyframes) {
  for (const ActionScript& script : scripts_) {
    if (script.sequence.name != keyframes) continue;
    // scripts_ and graph_ do not change after construction: the references stay valid.
    return [this, &script](const ActionCommand&, const Situation& situation) {
      return plan_script(script, situation);
    };
  }
  const KeyframeSequence* sequence = graph_.find(keyframes);
  if (sequence == nullptr) return nullptr;
  return [this, sequence](const ActionCommand&, const Situation& situation) {
    return plan_sequence(*sequence, situation);
  };
}

MotionPlan MotionFactory::plan(const Command& command, const MotionContext& context,
                               const JointTargets& targets) {
  const Situation situation{context, targets};
  return std::visit([&](const auto& request) { return plan_request(request, situation); },
                    command.request);
}

std::unique_ptr<MotionGenerator> MotionFactory::make_posture_path(const Posture& posture,
                                                                  double speed) const {
  return std::make_unique<PosturePathMotion>(graph_, posture, speed, true);
}

std::unique_ptr<MotionGenerator> MotionFactory::make_posture_path(const Posture& posture) const {
  return std::make_unique<PosturePathMotion>(graph_, posture, options_->default_speed);
}

std::unique_ptr<MotionGenerator> MotionFactory::make_stand_path() const {
  return make_posture_path(*stand_);
}

std::unique_ptr<MotionGenerator> MotionFactory::make_get_up(int num_tries) {
  // A policy that leaves a robot unsteady twice is followed by the transitions.
  if (get_up_policy_ != nullptr && get_up_policy_->find_fault().empty() && num_tries % 3 != 2) {
    return make_policy_motion(*get_up_policy_, {});
  }
  return std::make_unique<PosturePathMotion>(graph_, *stand_, options_->default_speed, false,
                                             num_tries);
}

std::unique_ptr<MotionGenerator> MotionFactory::make_push_recovery(const MotionContext& context,
                                                                   const JointTargets& targets) {
  const Situation situation{context, targets};
  if (find_leg_obstacle(situation) || !is_walking_stance(*model_, targets.position)) return nullptr;
  if (must_policy_catch(context.state)) return make_policy_recovery(WalkCommand{});
  return std::make_unique<WalkMotion>(*model_, *gait_, make_stand_path(), std::nullopt);
}

std::unique_ptr<MotionGenerator> MotionFactory::make_walk_recovery(const RobotState& state,
                                                                   const Eigen::Vector3d& velocity,
                                                                   const WalkCommand& walk) {
  if (recovery_ == nullptr || !is_walk_pushed(state, velocity)) return nullptr;
  return make_policy_recovery(walk);
}

std::unique_ptr<MotionGenerator> MotionFactory::make_policy_recovery(
    const WalkCommand& walk) const {
  return std::make_unique<PolicyMotion>(*model_, *recovery_, nullptr, make_stand_path(), walk,
                                        [] {});
}

bool MotionFactory::must_policy_catch(const RobotState& state) const {
  return recovery_ != nullptr && is_pushed_off(state, *recovery_->manifest->recovery_margin);
}

std::optional<StandingBalance> MotionFactory::make_standing_balance() const {
  if (!gait_) return std::nullopt;
  return StandingBalance(gait_->standing, *legs_);
}

MotionPlan MotionFactory::plan_request(const WalkCommand& walk, const Situation& situation) {
  if (walk_policy_ != nullptr) {
    const Policy& policy = *walk_policy_;
    if (const std::string fault = policy.find_fault(); !fault.empty()) {
      // The operator is told; the next walk is by the gait.
      walk_policy_ = nullptr;
      return Reason("policy-unusable", {policy.name, fault});
    }
    if (const auto obstacle = find_policy_obstacle(situation)) return *obstacle;
    return make_policy_motion(policy, walk);
  }
  if (const auto obstacle = find_obstacle_after_standing_up(situation)) return *obstacle;
  return std::make_unique<WalkMotion>(*model_, *gait_, make_stand_path(), walk);
}

MotionPlan MotionFactory::plan_request(const MoveToCommand& move_to, const Situation& situation) {
  if (const auto obstacle = find_obstacle_after_standing_up(situation)) return *obstacle;
  return std::make_unique<MoveToMotion>(*model_, *gait_, make_stand_path(), move_to);
}

std::optional<Reason> MotionFactory::find_posture_obstacle(const Posture& goal,
                                                           const Situation& situation) const {
  const std::string state = find_body_state(*model_, situation.context.state, options_->lying_tilt);
  // In an unknown state, such as held in the air, the motion looks for a path once it is known.
  const bool needs_path = !state.empty() && state != state_of(goal);
  if (needs_path && graph_.find_path(state, state_of(goal)).empty()) {
    return Reason("no-path", {state, goal.name});
  }
  return std::nullopt;
}

MotionPlan MotionFactory::plan_request(const PostureCommand& posture, const Situation& situation) {
  // Exists: find_fault() has checked the name.
  const Posture& goal = *model_->find_posture(posture.posture);
  if (auto obstacle = find_posture_obstacle(goal, situation)) return *std::move(obstacle);
  return make_posture_path(goal, posture.speed);
}

MotionPlan MotionFactory::plan_request(const JointChangeCommand& change,
                                       const Situation& situation) {
  if (auto support = find_relaxed_support(change, situation)) return *std::move(support);
  if (auto danger = guard_->find_danger(change, situation.context, situation.targets)) {
    return *danger;
  }
  return std::make_unique<JointChangeMotion>(change);
}

MotionPlan MotionFactory::plan_request(const ActionCommand& action, const Situation& situation) {
  const auto planner = actions_.find(action.action);
  if (planner != actions_.end()) return planner->second(action, situation);
  const auto taught = taught_.find(action.action);
  if (taught != taught_.end()) return plan_taught(taught->second, situation);
  return Reason("action-without-motion", {action.action});
}

MotionPlan MotionFactory::plan_request(const StopCommand& /*stop*/,
                                       const Situation& /*situation*/) {
  return std::make_unique<StopMotion>();
}

std::unique_ptr<MotionGenerator> MotionFactory::make_policy_motion(const Policy& policy,
                                                                   const WalkCommand& command) {
  return std::make_unique<PolicyMotion>(*model_, policy, make_stand_path(), make_stand_path(),
                                        command, [this, &policy] {
                                          if (&policy == walk_policy_) walk_policy_ = nullptr;
                                          if (&policy == get_up_policy_) get_up_policy_ = nullptr;
                                        });
}

MotionPlan MotionFactory::plan_policy(const Policy& policy, const Situation& situation) {
  if (const std::string fault = policy.find_fault(); !fault.empty()) {
    return Reason("policy-unusable", {policy.name, fault});
  }
  if (policy.manifest->kind == PolicyManifest::Kind::kWalk) {
    walk_policy_ = &policy;
    // A walk ends, and the next one is by the policy.
    return std::make_unique<StopMotion>();
  }
  if (const auto obstacle = find_policy_obstacle(situation)) return *obstacle;
  return make_policy_motion(policy, {});
}

MotionPlan MotionFactory::plan_kick(const ActionCommand& action, const Situation& situation,
                                    bool is_left) const {
  if (!kick_) return Reason("no-kick", {model_->name()});
  if (const auto obstacle = find_walk_obstacle(situation)) return *obstacle;
  const Eigen::Vector2d ball(action.ball_x, action.ball_y);
  if (const auto obstacle = KickMotion::find_obstacle(*kick_, is_left, ball)) return *obstacle;
  return std::make_unique<KickMotion>(*model_, *kick_, *gait_, make_stand_path(), is_left, ball,
                                      action.strength);
}

MotionPlan MotionFactory::plan_script(const ActionScript& script,
                                      const Situation& situation) const {
  if (const auto obstacle = find_walk_obstacle(situation)) return *obstacle;
  return std::make_unique<ScriptMotion>(*model_, script, *gait_, make_stand_path(),
                                        make_stand_path());
}

MotionPlan MotionFactory::plan_taught(const std::shared_ptr<const ActionScript>& script,
                                      const Situation& situation) const {
  const Posture* start = model_->find_posture(script->start);
  if (start == nullptr) start = stand_;
  if (auto obstacle = find_posture_obstacle(*start, situation)) return *std::move(obstacle);
  return std::make_unique<TaughtMotion>(*model_, script, make_posture_path(*start),
                                        starts_on_feet(*model_, *script));
}

// A keyframe transition plays from the state it starts in, and from no other.
MotionPlan MotionFactory::plan_sequence(const KeyframeSequence& sequence,
                                        const Situation& situation) const {
  const std::string state = find_body_state(*model_, situation.context.state, options_->lying_tilt);
  if (sequence.from != state) {
    return Reason("action-needs-state", {sequence.name, sequence.from, name_of(state)});
  }
  return std::make_unique<SequenceMotion>(sequence);
}

void MotionFactory::set_taught(const std::string& name,
                               std::shared_ptr<const ActionScript> script) {
  if (script == nullptr) {
    taught_.erase(name);
  } else {
    taught_[name] = std::move(script);
  }
}

std::optional<Reason> MotionFactory::find_relaxed_support(const JointChangeCommand& change,
                                                          const Situation& situation) const {
  const std::string state = find_body_state(*model_, situation.context.state, options_->lying_tilt);
  // A robot that is held in the air, in no known state, may be put down.
  if (!state.empty() && state != kOnFeet) return std::nullopt;
  for (size_t i = 0; i < change.joint_stiffness.size(); ++i) {
    // A stiffness that stays as it is, is NaN, for which the comparison is false.
    const bool is_soft = change.joint_stiffness[i] < kCarryingStiffness;
    const int motor = model_->find_motor(change.joint_names[i]);
    if (is_soft && carries_body(situation.context, motor)) {
      return Reason("joint-carries-robot", {change.joint_names[i]});
    }
  }
  return std::nullopt;
}

std::optional<Reason> MotionFactory::find_leg_obstacle(const Situation& situation) const {
  const RobotState& state = situation.context.state;
  if (is_lying(state, options_->lying_tilt)) return Reason("robot-fallen");
  return motion::find_walk_obstacle(*legs_, state, situation.targets.stiffness);
}

std::optional<Reason> MotionFactory::find_walk_obstacle(const Situation& situation) const {
  if (!gait_) return Reason("no-gait", {model_->name()});
  return find_leg_obstacle(situation);
}

std::optional<Reason> MotionFactory::find_policy_obstacle(const Situation& situation) const {
  // A robot that sits stands up before it walks, so that contact and tilt do not count yet; soft
  // legs do.
  const RobotState& state = situation.context.state;
  const bool sits = is_sitting(*model_, find_body_state(*model_, state, options_->lying_tilt));
  if (!sits) return find_leg_obstacle(situation);
  return find_soft_leg(*legs_, situation.targets.stiffness);
}

std::optional<Reason> MotionFactory::find_obstacle_after_standing_up(
    const Situation& situation) const {
  if (!gait_) return Reason("no-gait", {model_->name()});
  return find_policy_obstacle(situation);
}

}  // namespace nao::motion
