#include "daemons/motion/walk/gait.h"

#include <utility>

#include "common/parameter_table.h"

namespace nao::motion {
namespace {

#define NAO_GAIT_PARAMETER(group, key) NAO_PARAMETER(Gait, group, key)

const ParameterTable<Gait>& all_parameters() {
  static const ParameterTable<Gait> parameters = {
      NAO_GAIT_PARAMETER(timing, step_duration),
      NAO_GAIT_PARAMETER(timing, min_step_duration),
      NAO_GAIT_PARAMETER(timing, max_step_duration),
      NAO_GAIT_PARAMETER(timing, double_support_duration),
      NAO_GAIT_PARAMETER(timing, start_duration),
      NAO_GAIT_PARAMETER(timing, stop_duration),
      NAO_GAIT_PARAMETER(timing, raise_duration),
      NAO_GAIT_PARAMETER(timing, late_duration),
      NAO_GAIT_PARAMETER(timing, stop_horizon),
      NAO_GAIT_PARAMETER(stance, hip_height),
      NAO_GAIT_PARAMETER(stance, torso_pitch),
      NAO_GAIT_PARAMETER(stance, foot_separation),
      NAO_GAIT_PARAMETER(stance, turn_center),
      NAO_GAIT_PARAMETER(stance, zmp_forward),
      NAO_GAIT_PARAMETER(stance, zmp_inward),
      NAO_GAIT_PARAMETER(stance, com_time_constant),
      NAO_GAIT_PARAMETER(swing, height),
      NAO_GAIT_PARAMETER(swing, arrival_fraction),
      NAO_GAIT_PARAMETER(swing, toe_pitch_gain),
      NAO_GAIT_PARAMETER(swing, touchdown_load_ratio),
      NAO_GAIT_PARAMETER(swing, late_speed),
      NAO_GAIT_PARAMETER(swing, late_depth),
      NAO_GAIT_PARAMETER(step_limits, max_forward),
      NAO_GAIT_PARAMETER(step_limits, max_backward),
      NAO_GAIT_PARAMETER(step_limits, max_outward),
      NAO_GAIT_PARAMETER(step_limits, min_foot_separation),
      NAO_GAIT_PARAMETER(step_limits, max_turn_outward),
      NAO_GAIT_PARAMETER(step_limits, max_turn_inward),
      NAO_GAIT_PARAMETER(step_limits, turn_inward_without_spread),
      NAO_GAIT_PARAMETER(step_limits, square_distance),
      NAO_GAIT_PARAMETER(velocity, max_change_vx),
      NAO_GAIT_PARAMETER(velocity, max_change_vy),
      NAO_GAIT_PARAMETER(velocity, max_change_wz),
      NAO_GAIT_PARAMETER(velocity, envelope_exponent),
      NAO_GAIT_PARAMETER(velocity, path_gain),
      NAO_GAIT_PARAMETER(velocity, max_path_offset),
      NAO_GAIT_PARAMETER(velocity, full_speed_lag),
      NAO_GAIT_PARAMETER(velocity, slow_speed_lag),
      NAO_GAIT_PARAMETER(velocity, slow_speed),
      NAO_GAIT_PARAMETER(velocity, slow_turning),
      NAO_GAIT_PARAMETER(velocity, slow_envelope_exponent),
      NAO_GAIT_PARAMETER(velocity, dead_sensor_speed),
      NAO_GAIT_PARAMETER(zmp, gain),
      NAO_GAIT_PARAMETER(zmp, reach_forward),
      NAO_GAIT_PARAMETER(zmp, reach_backward),
      NAO_GAIT_PARAMETER(zmp, reach_sideways),
      NAO_GAIT_PARAMETER(feedback, initial_lag),
      NAO_GAIT_PARAMETER(feedback, com_position_gain),
      NAO_GAIT_PARAMETER(feedback, com_velocity_gain),
      NAO_GAIT_PARAMETER(feedback, footstep_gain),
      NAO_GAIT_PARAMETER(feedback, timing_gain),
      NAO_GAIT_PARAMETER(feedback, ankle_dcm_gain),
      NAO_GAIT_PARAMETER(feedback, bias_gain),
      NAO_GAIT_PARAMETER(feedback, max_bias),
      NAO_GAIT_PARAMETER(feedback, max_com_offset),
      NAO_GAIT_PARAMETER(feedback, com_offset_gain),
      NAO_GAIT_PARAMETER(orientation, gyro_ankle_pitch),
      NAO_GAIT_PARAMETER(orientation, gyro_ankle_roll),
      NAO_GAIT_PARAMETER(orientation, gyro_hip_pitch),
      NAO_GAIT_PARAMETER(orientation, gyro_hip_roll),
      NAO_GAIT_PARAMETER(orientation, tilt_ankle_pitch),
      NAO_GAIT_PARAMETER(orientation, tilt_ankle_roll),
      NAO_GAIT_PARAMETER(standing, ankle_pitch),
      NAO_GAIT_PARAMETER(standing, hip_pitch),
      NAO_GAIT_PARAMETER(standing, least_rate),
      NAO_GAIT_PARAMETER(servo, lead_time),
      NAO_GAIT_PARAMETER(servo, torque_scale),
      NAO_GAIT_PARAMETER(servo, velocity_scale),
      NAO_GAIT_PARAMETER(servo, inertia_scale),
      NAO_GAIT_PARAMETER(kick, ball_distance),
      NAO_GAIT_PARAMETER(kick, swing_reach),
      NAO_GAIT_PARAMETER(kick, swing_lift),
      NAO_GAIT_PARAMETER(arms, swing_gain),
  };
  return parameters;
}

#undef NAO_GAIT_PARAMETER

}  // namespace

std::optional<Gait::Contradiction> Gait::find_contradiction() const {
  if (timing.min_step_duration > timing.step_duration ||
      timing.step_duration > timing.max_step_duration) {
    return Contradiction{"timing.step_duration",
                         "must lie between min_step_duration and max_step_duration"};
  }
  if (step_limits.min_foot_separation > stance.foot_separation) {
    // The feet would never stand side by side, and the walk would not end.
    return Contradiction{"step_limits.min_foot_separation",
                         "must not be above stance.foot_separation"};
  }
  if (velocity.full_speed_lag >= velocity.slow_speed_lag) {
    return Contradiction{"velocity.slow_speed_lag", "must be above full_speed_lag"};
  }
  return std::nullopt;
}

// The file must hold all parameters and no others; each with its value inside its range.
Gait Gait::load(const std::filesystem::path& file, std::vector<Parameter>* parameters) {
  const YamlEntry root = YamlEntry::load(file);
  Gait gait;
  std::vector<Parameter> read;
  read_parameters(root, all_parameters(),
                  [&](const NamedParameter<Gait>& known, const YamlEntry& entry) {
                    entry.allow_only({"value", "range"});
                    const double value = entry.at("value").number();
                    const std::vector<double> range = entry.at("range").numbers(2);
                    // Written so that NaN fails, too.
                    if (!(range[0] <= value && value <= range[1]))
                      entry.fail("has a value outside its range");
                    known.in(gait) = value;
                    read.push_back({known.name, known.in, range[0], range[1]});
                  });
  for (const NamedParameter<Gait>& parameter : all_parameters()) (void)parameter.entry(root);
  if (const auto found = gait.find_contradiction()) {
    NamedParameter<Gait>{found->parameter, nullptr}.entry(root).fail(found->requirement);
  }
  if (parameters != nullptr) *parameters = std::move(read);
  return gait;
}

}  // namespace nao::motion
