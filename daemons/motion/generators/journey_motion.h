#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/generators/posture_motion.h"
#include "daemons/motion/transitions/transition_graph.h"

namespace nao::motion {

/** Way to a posture from wherever the body is: leg by leg along the graph of transitions, looking
 * after each where the body really is, then straight to the posture.
 *
 * Transitions are played as fast as they were verified in physics, since most would not work
 * slower; the speed asked for holds for the straight ways. */
class JourneyMotion : public MotionGenerator {
 public:
  /** @param graph, goal  Must outlive this. @param speed  Fraction of the maximum, (0, 1]. */
  JourneyMotion(const TransitionGraph& graph, const Posture& goal, double speed)
      : graph_(&graph), goal_(&goal), speed_(speed) {}

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override;
  void finish() override { is_finishing_ = true; }
  Mode mode() const override;
  bool means_to_stand() const override { return stands_; }
  double progress() const override;
  Reason reason() const override { return reason_; }
  void describe(MotionState& state) const override { state.num_tries = num_tries_; }

 private:
  enum class Leg { kStiffening, kResting, kTransition, kDirect };

  Phase choose_leg(const MotionContext& context, const JointTargets& targets);
  void play(const MotionContext& context, const KeyframeSequence& sequence,
            const JointTargets& targets);
  /** Whether the body must come to rest before it moves on from a state. */
  bool must_rest(const MotionContext& context, const std::string& state) const;
  /** Begins to, if that may free legs that did not reach a posture. */
  bool brings_feet_together(const MotionContext& context, const JointTargets& targets);
  Phase step_transition(const MotionContext& context, JointTargets& targets);

  const TransitionGraph* graph_;
  const Posture* goal_;
  double speed_;

  Leg leg_ = Leg::kStiffening;
  double time_ = 0;
  /** s for which the torso has not turned. */
  double time_still_ = 0;
  const KeyframeSequence* sequence_ = nullptr;
  KeyframePlayer player_;
  int stage_ = 0;
  std::optional<PostureMotion> direct_;
  int num_legs_ = 0;
  /** Transitions that did not lead where they should: another way comes first from then on. */
  std::vector<const KeyframeSequence*> failed_;
  int num_feet_together_ = 0;
  /** Tries to get up: a roll and what follows it are one. */
  int num_tries_ = 0;
  bool is_from_lying_ = false;
  /** The last transition ended where it should. */
  bool is_on_its_way_ = false;
  bool has_approached_ = false;
  /** The leg is a straight way on the feet. */
  bool stands_ = false;
  bool is_finishing_ = false;
  Reason reason_;
};

}  // namespace nao::motion
