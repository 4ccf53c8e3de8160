#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/parameter_group.h"

namespace nao::motion {

/** All tuned parameters of a robot's walk, as read from data/robots/NAME/gait.yaml.
 *
 * Groups and members carry the file's keys. The file states for each value its unit, its meaning,
 * the range in which nao-walk-tuner may choose it, and how it was found. */
struct Gait {
  /** Durations, s. */
  NAO_PARAMETER_GROUP(Timing, timing, step_duration, min_step_duration, max_step_duration,
                      double_support_duration, start_duration, stop_duration, raise_duration,
                      late_duration, stop_horizon);
  /** Nominal pose of torso and feet: m, rad; time constant, s. */
  NAO_PARAMETER_GROUP(Stance, stance, hip_height, torso_pitch, foot_separation, turn_center,
                      zmp_forward, zmp_inward, com_time_constant);
  /** Trajectory of the swing foot: m, fractions, rad s/m, m/s. */
  NAO_PARAMETER_GROUP(Swing, swing, height, arrival_fraction, toe_pitch_gain, touchdown_load_ratio,
                      late_speed, late_depth);
  /** Bounds of one footstep, measured from the support foot: m, rad. */
  NAO_PARAMETER_GROUP(StepLimits, step_limits, max_forward, max_backward, max_outward,
                      min_foot_separation, max_turn_outward, max_turn_inward,
                      turn_inward_without_spread, square_distance);
  /** Velocity of the steps: change per step, m/s and rad/s; exponent; 1/s; m; lags in s and the
   * fractions of the greatest velocity, and of the greatest turn, at the longer one. */
  NAO_PARAMETER_GROUP(Velocity, velocity, max_change_vx, max_change_vy, max_change_wz,
                      envelope_exponent, path_gain, max_path_offset, full_speed_lag, slow_speed_lag,
                      slow_speed, slow_turning, slow_envelope_exponent);
  /** Control law of the zero moment point: gain and range on the sole, m. */
  NAO_PARAMETER_GROUP(Zmp, zmp, gain, reach_forward, reach_backward, reach_sideways);
  /** Feedback of the measured center of mass: s, 1/s, dimensionless gains, bounds in m. */
  NAO_PARAMETER_GROUP(Feedback, feedback, initial_lag, com_position_gain, com_velocity_gain,
                      footstep_gain, timing_gain, ankle_dcm_gain, bias_gain, max_bias,
                      max_com_offset, com_offset_gain);
  /** Feedback of the torso's angular velocity, s, and tilt, dimensionless, to joint angles. */
  NAO_PARAMETER_GROUP(Orientation, orientation, gyro_ankle_pitch, gyro_ankle_roll, gyro_hip_pitch,
                      gyro_hip_roll, tilt_ankle_pitch, tilt_ankle_roll);
  /** Feedback of the torso's angular velocity while the robot stands: s, s, rad/s; margin of the
   * capture point below which it steps, m. */
  NAO_PARAMETER_GROUP(Standing, standing, ankle_pitch, hip_pitch, least_rate, step_margin);
  /** Feedforward to the position servos: s, dimensionless scales. */
  NAO_PARAMETER_GROUP(Servo, servo, lead_time, torque_scale, velocity_scale, inertia_scale);
  /** Kick during the walk, m. */
  NAO_PARAMETER_GROUP(Kick, kick, ball_distance, swing_reach, swing_lift);
  /** Arms: swing in rad per m of stride. */
  NAO_PARAMETER_GROUP(Arms, arms, swing_gain);

  /** One entry of the file: where its value is stored, and the range of the tuner. */
  struct Parameter {
    /** "GROUP.KEY". */
    std::string name;
    std::function<double&(Gait&)> in;
    double lower = 0;
    double upper = 0;

    double value(Gait gait) const { return in(gait); }
  };

  /** A value that others of the same gait exclude. */
  struct Contradiction {
    /** "GROUP.KEY". */
    std::string parameter;
    std::string requirement;
  };
  /** The first contradiction between values: with it a walk cannot begin or end. */
  std::optional<Contradiction> find_contradiction() const;

  /** Reads data/robots/NAME/gait.yaml, which must hold every parameter.
   * @param parameters  If given, set to all entries with their ranges, in the file's order.
   * @throws ModelError  naming the file, the line and the fault. */
  static Gait load(const std::filesystem::path& file, std::vector<Parameter>* parameters = nullptr);
};

}  // namespace nao::motion
