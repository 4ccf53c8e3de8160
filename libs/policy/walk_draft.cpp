#include "policy/walk_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/constants.h"
#include "common/error.h"
#include "kinematics/leg_joints.h"

namespace nao {
namespace {

// Steps of the T1 by Booster Gym, 1.5 cycles a second at a hip height of 0.55 m, in units of the
// pendulum's angular frequency.
constexpr double kFrequency = 0.355;
// Greatest commands, as fractions of the speed sqrt(g hip height), and rad/s. Chosen: what a T1
// learns from nothing in ten minutes.
constexpr double kForward = 0.3;
constexpr double kBackward = 0.15;
constexpr double kSideways = 0.1;
constexpr double kTurning = 0.6;

constexpr const char* kHead = R"(kind: walk
network: policy.onnx
source: trained by tools/policy-train
rate: 50
observations:
  - {{quantity: projected_gravity}}
  - {{quantity: angular_velocity, scale: 0.25}}
  - {{quantity: velocity_command}}
  - {{quantity: joint_position}}
  - {{quantity: joint_velocity, scale: 0.1}}
  - {{quantity: last_action}}
  - {{quantity: phase_sine}}
  - {{quantity: phase_cosine}}
phase: {{frequency: {:.2f}, at_rest: zeros}}
action: {{scale: 0.25}}
joints:
)";

}  // namespace

std::string draft_walk_policy(const RobotModel& model) {
  const std::vector<double>& ready = model.ready_posture().position;
  const std::vector<Eigen::Isometry3d> poses = model.link_poses(ready);
  std::vector<int> motors;
  double height = 0;
  for (size_t i = 0; i < 2; ++i) {
    const LegDescription& leg = model.legs()[i];
    const std::vector<int> joints = own_leg_joints(model, i);
    if (joints.empty()) throw ModelError(model.name() + " has a leg without joints of its own");
    const int hip = model.joints()[static_cast<size_t>(joints.front())].child_link;
    height = poses[static_cast<size_t>(hip)].translation().z() -
             poses[static_cast<size_t>(leg.sole)].translation().z();
    for (const int joint : joints) {
      const int motor = model.motor_of(joint);
      // Coupled joints have one motor.
      if (std::find(motors.begin(), motors.end(), motor) == motors.end()) motors.push_back(motor);
    }
  }
  std::string text = fmt::format(kHead, kFrequency * std::sqrt(kGravity / height));
  for (const int motor : motors) {
    const auto index = static_cast<size_t>(motor);
    // Not -0.
    const double angle = std::round(1e3 * ready[index]) / 1e3 + 0.0;
    text +=
        fmt::format("  - {{name: \"{}\", default: {:.3f}}}\n", model.motor_names()[index], angle);
  }
  const double speed = std::sqrt(kGravity * height);
  text += fmt::format("command: {{vx: [{:.2f}, {:.2f}], vy: [{:.2f}, {:.2f}], wz: [{}, {}]}}\n",
                      -kBackward * speed, kForward * speed, -kSideways * speed, kSideways * speed,
                      -kTurning, kTurning);
  return text;
}

}  // namespace nao
