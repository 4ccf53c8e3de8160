#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

class YamlEntry;

/** What a policy observes, in this order; docs/policies.md has the frames and units. */
enum class PolicyQuantity {
  kAngularVelocity,
  kLinearVelocity,
  kProjectedGravity,
  kVelocityCommand,
  kLinearCommand,
  kTurnCommand,
  kPhaseSine,
  kPhaseCosine,
  kJointPosition,
  kJointVelocity,
  kLastAction,
  kConstant,
};

/** Name in manifests: "angular_velocity". */
const char* to_string(PolicyQuantity quantity);

/** One term of the observation. */
struct PolicyTerm {
  PolicyQuantity quantity = PolicyQuantity::kConstant;
  /** Numbers of one step. */
  int size = 0;
  /** Factor of each of them, (size); applied after the clip. */
  std::vector<double> scale;
  /** Bound of the unscaled numbers; infinity: none. */
  double clip = 0;
  /** Steps of this term that the network sees, the newest included. */
  int num_steps = 1;
  /** Lead of each foot, cycles, of a phase; the numbers of a constant. */
  std::vector<double> values;
};

/** A joint that the policy moves or holds. */
struct PolicyJoint {
  int motor = -1;
  /** Angle at action 0, rad. */
  double default_angle = 0;
  /** Change of the target for each unit of the action, rad. */
  double scale = 1;
  /** Gains of the servo, N m/rad and N m s/rad; NaN: the robot's own. */
  double stiffness = 0;
  double damping = 0;
};

/** Range of a commanded velocity; m/s or rad/s. */
struct PolicyRange {
  double lower = 0;
  double upper = 0;
};

/** Description of a network that moves a robot: what it sees, in which order, and what its outputs
 * mean. Read from policy.yaml in data/robots/NAME/policies/POLICY/. */
struct PolicyManifest {
  enum class Kind { kWalk, kGetUp, kAction };
  /** What the phase does while the commanded velocity is 0: it goes on; its terms are 0; or both
   * feet are in the middle of the cycle. */
  enum class PhaseAtRest { kContinues, kZeros, kHalfCycle };

  Kind kind = Kind::kWalk;
  /** Name of the ONNX file in the same folder. */
  std::string network;
  /** Time of one step, s. */
  double period = 0.02;
  std::vector<PolicyTerm> terms;
  /** The newest of stacked steps comes first; whole steps follow one another instead of terms. */
  bool is_newest_first = false;
  bool is_by_step = false;
  /** Before the first step, the history is that step; otherwise zeros. */
  bool starts_with_first = false;
  /** Bound of the scaled observation; infinity: none. */
  double observation_clip = 0;
  /** Cycles per second, 0: none; and where it starts, cycles. */
  double phase_frequency = 0;
  double phase_start = 0;
  PhaseAtRest phase_at_rest = PhaseAtRest::kContinues;
  /** Joints in the order of the actions. */
  std::vector<PolicyJoint> joints;
  /** Motors in the order of the observed joints; those of `joints` if the file does not say. */
  std::vector<int> observed_motors;
  /** Bound of the actions; infinity: none. */
  double action_clip = 0;
  /** Angles of all motors while action and command are 0, rad, motor order. */
  std::vector<double> default_position;
  /** Gains of all motors, NaN: the robot's own; motor order. */
  std::vector<double> kp;
  std::vector<double> kd;
  PolicyRange vx;
  PolicyRange vy;
  PolicyRange wz;
  /** Longest duration of a get-up and duration of an action, s. */
  double duration = 0;
  /** Tilt of the torso from which on it does not recover, rad; nothing: as of other walks. */
  std::optional<double> fall_tilt;
  /** The walk, which has a phase, is the push recovery of a robot that stands, whose capture point
   * is so far outside of the soles, m; nothing: it is not. */
  std::optional<double> recovery_margin;

  /** Numbers of an observation with all its steps. */
  int num_observations() const;
  int num_actions() const { return static_cast<int>(joints.size()); }

  /** @throws ModelError  with the file, the line, the key and what is wrong with it. */
  static PolicyManifest load(const RobotModel& model, const std::filesystem::path& file);
  /** The same of a text; errors name it `name`. */
  static PolicyManifest parse(const RobotModel& model, const std::string& text,
                              const std::string& name);
};

}  // namespace nao
