#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nao::motion {

/** Everything about how a robot walks that is tuned: robots/NAME/gait.yaml, which says what each
 * value is, its unit and where it comes from. The members carry the file's keys. */
struct Gait {
  // Rhythm, s.
  double step_duration = 0;
  double min_step_duration = 0;
  double max_step_duration = 0;
  double double_support = 0;
  double start_duration = 0;
  double stop_duration = 0;

  // Stance and swing: m, rad.
  double hip_height = 0;
  double torso_pitch = 0;
  double foot_separation = 0;
  double turn_centre = 0;
  double step_height = 0;
  double zmp_forward = 0;
  double zmp_inward = 0;
  double swing_arrival = 0;
  double swing_pitch = 0;

  // Steps: m, rad.
  double max_step_forward = 0;
  double max_step_backward = 0;
  double max_step_outward = 0;
  double min_foot_separation = 0;
  double max_turn_outward = 0;
  double max_turn_inward = 0;
  double turn_inward = 0;

  // Velocities: m/s, rad/s, and their change per step.
  double max_change_forward = 0;
  double max_change_sideways = 0;
  double max_change_turning = 0;
  double envelope_exponent = 0;
  double raise_duration = 0;
  double path_gain = 0;

  // Servos: s; shares.
  double lead_time = 0;
  double reaction_time = 0;
  double torque_share = 0;
  double damping_share = 0;
  double mass_centre_time = 0;

  // Balance.
  double zmp_gain = 0;
  double zmp_reach_forward = 0;
  double zmp_reach_backward = 0;
  double zmp_reach_sideways = 0;
  double absorb_position = 0;
  double absorb_velocity = 0;
  double step_gain = 0;
  double timing_gain = 0;
  double dcm_gain = 0;
  double gyro_ankle_pitch = 0;
  double gyro_ankle_roll = 0;
  double gyro_hip_pitch = 0;
  double gyro_hip_roll = 0;
  double tilt_ankle_pitch = 0;
  double tilt_ankle_roll = 0;
  double bias_gain = 0;
  double touchdown_share = 0;

  // Kick out of the walk: m.
  double kick_distance = 0;
  double kick_reach = 0;
  double kick_lift = 0;

  // Arms: rad, rad per m.
  double shoulder_pitch = 0;
  double shoulder_roll = 0;
  double elbow_yaw = 0;
  double elbow_roll = 0;
  double arm_swing = 0;

  /** One entry of the file: which member, and between what a tuner may choose it. */
  struct Parameter {
    const char* key;
    double Gait::*member;
    double lower = 0;
    double upper = 0;
  };

  /** Reads robots/NAME/gait.yaml: for every member a value and the range that it may be tuned in.
   * @param parameters  If given, set to all entries, with their ranges.
   * @throws ModelError  naming the line and what is wrong with it. */
  static Gait load(const std::filesystem::path& file, std::vector<Parameter>* parameters = nullptr);
};

}  // namespace nao::motion
