#include "daemons/motion/walk/gait.h"

#include <algorithm>
#include <string>

#include "common/yaml_entry.h"

namespace nao::motion {
namespace {

#define NAO_GAIT_PARAMETER(name) \
  Gait::Parameter {              \
#name, &Gait::name           \
  }

const std::vector<Gait::Parameter>& all_parameters() {
  static const std::vector<Gait::Parameter> parameters = {
      NAO_GAIT_PARAMETER(step_duration),       NAO_GAIT_PARAMETER(min_step_duration),
      NAO_GAIT_PARAMETER(max_step_duration),   NAO_GAIT_PARAMETER(double_support),
      NAO_GAIT_PARAMETER(start_duration),      NAO_GAIT_PARAMETER(stop_duration),
      NAO_GAIT_PARAMETER(hip_height),          NAO_GAIT_PARAMETER(torso_pitch),
      NAO_GAIT_PARAMETER(foot_separation),     NAO_GAIT_PARAMETER(turn_centre),
      NAO_GAIT_PARAMETER(step_height),         NAO_GAIT_PARAMETER(zmp_forward),
      NAO_GAIT_PARAMETER(zmp_inward),          NAO_GAIT_PARAMETER(swing_arrival),
      NAO_GAIT_PARAMETER(swing_pitch),         NAO_GAIT_PARAMETER(max_step_forward),
      NAO_GAIT_PARAMETER(max_step_backward),   NAO_GAIT_PARAMETER(max_step_outward),
      NAO_GAIT_PARAMETER(min_foot_separation), NAO_GAIT_PARAMETER(max_turn_outward),
      NAO_GAIT_PARAMETER(max_turn_inward),     NAO_GAIT_PARAMETER(turn_inward),
      NAO_GAIT_PARAMETER(max_change_forward),  NAO_GAIT_PARAMETER(max_change_sideways),
      NAO_GAIT_PARAMETER(max_change_turning),  NAO_GAIT_PARAMETER(envelope_exponent),
      NAO_GAIT_PARAMETER(raise_duration),      NAO_GAIT_PARAMETER(path_gain),
      NAO_GAIT_PARAMETER(lead_time),           NAO_GAIT_PARAMETER(reaction_time),
      NAO_GAIT_PARAMETER(torque_share),        NAO_GAIT_PARAMETER(damping_share),
      NAO_GAIT_PARAMETER(mass_centre_time),    NAO_GAIT_PARAMETER(zmp_gain),
      NAO_GAIT_PARAMETER(zmp_reach_forward),   NAO_GAIT_PARAMETER(zmp_reach_backward),
      NAO_GAIT_PARAMETER(zmp_reach_sideways),  NAO_GAIT_PARAMETER(absorb_position),
      NAO_GAIT_PARAMETER(absorb_velocity),     NAO_GAIT_PARAMETER(step_gain),
      NAO_GAIT_PARAMETER(timing_gain),         NAO_GAIT_PARAMETER(dcm_gain),
      NAO_GAIT_PARAMETER(gyro_ankle_pitch),    NAO_GAIT_PARAMETER(gyro_ankle_roll),
      NAO_GAIT_PARAMETER(gyro_hip_pitch),      NAO_GAIT_PARAMETER(gyro_hip_roll),
      NAO_GAIT_PARAMETER(tilt_ankle_pitch),    NAO_GAIT_PARAMETER(tilt_ankle_roll),
      NAO_GAIT_PARAMETER(bias_gain),           NAO_GAIT_PARAMETER(touchdown_share),
      NAO_GAIT_PARAMETER(kick_distance),       NAO_GAIT_PARAMETER(kick_reach),
      NAO_GAIT_PARAMETER(kick_lift),           NAO_GAIT_PARAMETER(shoulder_pitch),
      NAO_GAIT_PARAMETER(shoulder_roll),       NAO_GAIT_PARAMETER(elbow_yaw),
      NAO_GAIT_PARAMETER(elbow_roll),          NAO_GAIT_PARAMETER(arm_swing),
  };
  return parameters;
}

#undef NAO_GAIT_PARAMETER

}  // namespace

Gait Gait::load(const std::filesystem::path& file, std::vector<Parameter>* parameters) {
  const YamlEntry root = YamlEntry::load(file);
  Gait gait;
  std::vector<Parameter> read;
  for (const auto& [key, entry] : root.entries()) {
    const std::string& name = key;
    const auto known = std::find_if(all_parameters().begin(), all_parameters().end(),
                                    [&](const Parameter& p) { return name == p.key; });
    if (known == all_parameters().end()) entry.fail("is unknown");
    entry.allow_only({"value", "range"});
    const double value = entry.at("value").number();
    const std::vector<double> range = entry.at("range").numbers(2);
    if (!(range[0] <= value && value <= range[1])) entry.fail("has a value outside its range");
    gait.*known->member = value;
    read.push_back({known->key, known->member, range[0], range[1]});
  }
  for (const Parameter& parameter : all_parameters()) root.at(parameter.key);
  if (gait.min_step_duration > gait.step_duration || gait.step_duration > gait.max_step_duration) {
    root.at("step_duration").fail("must lie between the shortest and the longest step");
  }
  if (parameters != nullptr) *parameters = std::move(read);
  return gait;
}

}  // namespace nao::motion
