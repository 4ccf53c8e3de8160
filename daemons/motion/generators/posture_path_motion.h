#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/generators/posture_motion.h"
#include "daemons/motion/transitions/ankle_damping.h"
#include "daemons/motion/transitions/keyframes.h"
#include "daemons/motion/transitions/transition_graph.h"

namespace nao::motion {

/** Path to a posture from any state of the body: transitions of the graph one after the other, then
 * a straight line of the joints to the posture.
 *
 * After each transition the state of the body is measured and the path is planned anew, so that a
 * transition that ended elsewhere is a detour, not a failure. Transitions are played at the speed
 * at which they were verified in physics; the commanded speed applies to the straight lines. */
class PosturePathMotion : public MotionGenerator {
 public:
  /** @param graph, goal  Must outlive this. @param speed  Fraction of the maximum, (0, 1].
   * @param is_exact  Whether feet that keep the joints slightly off a standing goal are brought
   * together. A robot that only has to stand saves this time.
   * @param num_tries  Attempts to get up that have ended in a fall soon afterwards. */
  PosturePathMotion(const TransitionGraph& graph, const Posture& goal, double speed,
                    bool is_exact = false, int num_tries = 0)
      : graph_(&graph),
        goal_(&goal),
        speed_(speed),
        is_exact_(is_exact),
        num_tries_(num_tries),
        num_relapses_(num_tries) {}

  void start(const MotionContext& context, const JointTargets& targets) override;
  Phase step(const MotionContext& context, JointTargets& targets) override;
  bool can_be_replaced() const override;
  void finish() override { is_finishing_ = true; }
  Mode mode() const override;
  bool must_stay_upright() const override { return is_standing_line_; }
  double progress() const override;
  Reason reason() const override { return reason_; }
  void describe(MotionState& state) const override { state.num_tries = num_tries_; }

 private:
  /** Parts of the path. */
  enum class Segment {
    /** Limp motors become stiff. */
    kStiffening,
    /** Waits until the body lies still; then the next segment is chosen. */
    kResting,
    /** Plays a transition of the graph. */
    kTransition,
    /** Straight line of the joints to the goal. */
    kLine,
  };

  /** The transition that is played. */
  struct Transition {
    const KeyframeSequence* sequence = nullptr;
    KeyframePlayer player;
    /** Of a transition with keyframes that damp. */
    std::optional<AnkleDamping> damping{};
    int stage = 0;
    /** Time for which the targets have waited at the stage's end, s. */
    double time_late = 0;
  };

  Phase step_resting(const MotionContext& context, JointTargets& targets);
  Phase step_transition(const MotionContext& context, JointTargets& targets);
  Phase step_line(const MotionContext& context, JointTargets& targets);
  void stiffen(const MotionContext& context, std::vector<double>& stiffness);
  Phase choose_segment(const MotionContext& context, const JointTargets& targets);
  Phase choose_segment_in_goal_state(const MotionContext& context, const JointTargets& targets);
  /** @param state  State of the body, other than the goal's. */
  Phase choose_transition(const MotionContext& context, const JointTargets& targets,
                          const std::string& state);
  void play(const MotionContext& context, const KeyframeSequence& sequence,
            const JointTargets& targets);
  void rest(const MotionContext& context);
  /** Notes whether the robot is getting up: from lying until it is on its feet or at the goal.
   * @param state  State of the body. */
  void note_getting_up(const std::string& state);
  /** Whether the body must come to rest before it moves on from a state. */
  bool must_rest(const MotionContext& context, const std::string& state) const;
  /** How often getting up failed by transitions between the same states as this one. */
  int count_failures(const KeyframeSequence& sequence) const;
  /** Starts to bring the feet together, if that may free legs that did not reach the posture.
   * @return Whether it did. */
  bool bring_feet_together(const MotionContext& context, const JointTargets& targets);

  /** Starts the goal's approach transition once more, if a joint is blocked: by an arm below the
   * body, for example. @return Whether it did. */
  bool approach_again(const MotionContext& context, const JointTargets& targets);

  const TransitionGraph* graph_;
  const Posture* goal_;
  double speed_;
  bool is_exact_;

  Segment segment_ = Segment::kStiffening;
  /** Time since the segment began, s. */
  double time_ = 0;
  /** Time for which the torso has not turned, s. */
  double time_still_ = 0;
  Transition transition_;
  std::optional<PostureMotion> line_;

  int num_segments_ = 0;
  /** Transitions that did not end where they should: other paths are preferred from then on. */
  std::vector<const KeyframeSequence*> failed_;
  /** The same since the path began. */
  std::vector<const KeyframeSequence*> all_failed_;
  int num_feet_together_ = 0;
  /** Attempts to get up: a roll and the get-up motion after it count as one. */
  int num_tries_ = 0;
  /** Those before this path, each with a fall soon after it. */
  int num_relapses_ = 0;
  /** The robot lay, and is neither on its feet yet nor in the goal's state. */
  bool is_getting_up_ = false;
  /** The last transition ended where it should. */
  bool is_on_path_ = false;
  /** The targets rest at the last keyframe of a transition. */
  bool is_at_keyframe_ = false;
  bool has_approached_ = false;
  bool has_approached_again_ = false;
  /** The segment is a line between two postures on the feet. */
  bool is_standing_line_ = false;
  bool is_finishing_ = false;
  Reason reason_;
};

}  // namespace nao::motion
