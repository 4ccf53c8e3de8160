#include "phone-gateway/server/core/robot_mirror.h"

#include <cmath>

namespace nao::gateway {
namespace {

// The protocol's modes have the values of motion_state_t, as Mode has.
static_assert(static_cast<int>(Mode::kRelaxed) == naoremote::MODE_RELAXED);
static_assert(static_cast<int>(Mode::kNoRobot) == naoremote::MODE_NO_ROBOT);
static_assert(kNumModes == naoremote::Mode_ARRAYSIZE);

}  // namespace

Pose2 RobotSnapshot::torso_on_ground() const {
  const auto& [w, x, y, z] = torso_orientation;
  return {{torso_position[0], torso_position[1]},
          heading_of(Eigen::Quaterniond(w, x, y, z).toRotationMatrix())};
}

// The robot's clock now, from its last state and the time since.
int64_t RobotMirror::calc_robot_utime(double now) const {
  if (!has_state_) return 0;
  return robot_.utime + std::llround((now - received_at_) * 1e6);
}

void RobotMirror::write(naoremote::State& state, bool is_available, double now) const {
  state.set_utime(static_cast<uint64_t>(robot_.utime));
  state.set_age_ms((now - received_at_) * 1e3);
  state.set_sent_at(now);
  state.mutable_joint_position()->Reserve(static_cast<int>(robot_.joint_position.size()));
  for (const double position : robot_.joint_position) {
    state.add_joint_position(static_cast<float>(position));
  }
  for (const double w : robot_.torso_orientation) {
    state.add_torso_orientation(static_cast<float>(w));
  }
  for (const double x : robot_.torso_position) state.add_torso_position(static_cast<float>(x));
  state.mutable_light_rgb()->Assign(light_rgb_.begin(), light_rgb_.end());
  // The last pose stays visible; what the robot does is not known.
  if (!is_available) {
    state.set_mode(naoremote::MODE_NO_ROBOT);
    state.set_progress(-1);
    return;
  }
  if (body_) *state.mutable_body() = *body_;
  state.set_mode(static_cast<naoremote::Mode>(motion_.mode));
  state.set_posture(motion_.posture);
  if (motion_.activity) *state.mutable_activity() = *motion_.activity;
  state.set_progress(static_cast<float>(motion_.progress));
  state.set_vx(static_cast<float>(motion_.velocity.vx));
  state.set_vy(static_cast<float>(motion_.velocity.vy));
  state.set_wz(static_cast<float>(motion_.velocity.wz));
  state.set_stiffness(static_cast<float>(motion_.stiffness));
}

}  // namespace nao::gateway
