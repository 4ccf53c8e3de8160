#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/random.h"
#include "daemons/motion/robot_state.h"
#include "kinematics/kinematics.h"
#include "policy/observation_builder.h"
#include "policy/policy_manifest.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"
#include "robot_model/target_limiter.h"
#include "sim/disturbances.h"
#include "sim/world.h"
#include "tools/policy-train/assist_schedule.h"
#include "tools/policy-train/push_schedule.h"
#include "tools/policy-train/reward_terms.h"

namespace nao::policy_train {

/** What the episodes of a policy are. */
struct EnvironmentOptions {
  std::shared_ptr<const RobotModel> model;
  std::shared_ptr<const PolicyManifest> manifest;
  std::shared_ptr<const sim::DisturbanceSet> disturbances;
  SceneFile scene;
  /** Physics engine, see sim::WorldOptions::engine. */
  std::string engine = "fast";
  /** Longest episode, and mean time between two commanded velocities, s. */
  double episode_time = 20;
  double command_time = 5;
  /** Greatest horizontal impulse that hits the torso about every two seconds, N s for each kg of
   * the robot, see PushSchedule; 0: no pushes. */
  double push = 0;
  /** First pull on the torso of a robot that learns to get up, see AssistSchedule. */
  double assist = 0.6;
  /** Share of the episodes with velocity 0 throughout. */
  double rest_share = 0;
  /** Greatest difference of each moved joint from its default angle at the start, rad. Chosen. */
  double start_spread = 0.05;
  /** m/s, m/s, rad/s; nothing: drawn from the manifest's ranges and reached as in nao-motion. */
  std::optional<Eigen::Vector3d> command;
};

/** Numbers that only the trainer's critic sees: linear velocity of the torso in its own frame, m/s
 * (3); its angular velocity, rad/s (3); its height as a fraction of the start's, less 1; the load
 * on both feet as a fraction of the weight (2). */
inline constexpr int kNumPrivileged = 9;

/** What one step of an environment writes. */
struct StepOutput {
  /** (manifest.num_observations()), (kNumPrivileged), (kNumRewardTerms). */
  float* observation = nullptr;
  /** (manifest.num_observations()), of the episode's end, where one ended in this step. */
  float* final_observation = nullptr;
  float* privileged = nullptr;
  float* reward_terms = nullptr;
  /** 1 if the episode ended in this step: the robot fell; or its time was over. The observation is
   * then the next episode's first one. */
  uint8_t* terminated = nullptr;
  uint8_t* truncated = nullptr;
};

/** One robot whose joints a policy that is being trained moves, in episodes.
 *
 * The seed draws the robot, once, and everything random in its episodes. The same seed and actions
 * on the same build give the same bits. */
class PolicyEnvironment {
 public:
  /** @param pushes  Must outlive this, and changes between steps only.
   * @throws ConfigError, ModelError  as sim::World does. */
  PolicyEnvironment(const EnvironmentOptions& options, const PushSchedule& pushes, uint64_t seed);

  /** Begins an episode: the robot at its default angles, at rest, or in its ready posture and
   * pushed, as when nao-motion lets a policy catch it; a get-up's robot lies, or begins tilted. */
  void reset(const StepOutput& output);
  /** One step of the policy. @param action  (manifest.num_actions()), finite: others count as 0. */
  void step(const float* action, const StepOutput& output);

  /** Its outcome is of a push that was decided in the last step. */
  const RobotPushes& pushes() const { return pushes_; }

 private:
  /** @param is_ready  In the ready posture. */
  void place(bool is_ready);
  void place_tilted();
  void lay_down();
  void set_targets();
  void draw_goal();
  void push();
  bool is_get_up() const { return options_.manifest->kind == PolicyManifest::Kind::kGetUp; }
  /** Time in the episode, s. */
  double time() const { return num_steps_ * options_.manifest->period; }
  /** One tick of the simulation. Sent targets change as fast as the motors turn at most. */
  void step_tick();
  /** Steps with the targets that were sent last. @param duration  s. */
  void hold(double duration);
  void observe(const StepOutput& output);
  void sample(MotionSample& sample) const;
  /** Where the robot is and moves, as nao-motion estimates it, as far as push recovery asks. */
  void find_state();
  /** Begins push recovery: it steps in place. */
  void begin_recovery();
  /** As nao-motion does: begins push recovery, and has the foot swing that a push bears on. */
  void answer_push();

  EnvironmentOptions options_;
  Random random_;
  RobotPushes pushes_;
  AssistSchedule assist_;
  /** The velocity is 0 throughout this episode. */
  bool is_resting_ = false;
  std::unique_ptr<sim::World> world_;
  ObservationBuilder builder_;
  PolicyInput input_;
  /** What the commanded velocity changes to. */
  Eigen::Vector3d goal_ = Eigen::Vector3d::Zero();
  std::vector<float> action_;
  sim::MotorTargets targets_;
  TargetLimiter limiter_;
  /** Angles that were sent last, rad, and those of this step; motor order. */
  std::vector<double> sent_;
  std::vector<double> position_;
  /** At the default angles; present from the end of the constructor on. */
  std::optional<MotionSample> start_;
  /** At the begin and the end of a step. */
  MotionSample before_;
  MotionSample after_;
  int ticks_per_step_ = 1;
  int num_steps_ = 0;
  bool is_first_episode_ = true;
  /** Steps of this episode until which a robot that was pushed steps in place. */
  int recovery_end_ = 0;
  Kinematics kinematics_;
  motion::RobotState state_;
  /** Since a push changed which foot swings, gait cycles. */
  double cycles_since_outward_ = 0;
  int max_steps_ = 0;
};

}  // namespace nao::policy_train
