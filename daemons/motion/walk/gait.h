#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nao::motion {

/** All tuned parameters of a robot's walk, as read from data/robots/NAME/gait.yaml.
 *
 * Groups and members carry the file's keys. The file states for each value its unit, its meaning,
 * the range in which nao-walk-tuner may choose it, and how it was found. */
struct Gait {
  /** Durations, s. */
  struct Timing {
    double step_duration = 0;
    double min_step_duration = 0;
    double max_step_duration = 0;
    double double_support_duration = 0;
    double start_duration = 0;
    double stop_duration = 0;
    double raise_duration = 0;
    double late_duration = 0;
    double stop_horizon = 0;
  };
  /** Nominal pose of torso and feet: m, rad; time constant, s. */
  struct Stance {
    double hip_height = 0;
    double torso_pitch = 0;
    double foot_separation = 0;
    double turn_center = 0;
    double zmp_forward = 0;
    double zmp_inward = 0;
    double com_time_constant = 0;
  };
  /** Trajectory of the swing foot: m, fractions, rad s/m, m/s. */
  struct Swing {
    double height = 0;
    double arrival_fraction = 0;
    double toe_pitch_gain = 0;
    double touchdown_load_ratio = 0;
    double late_speed = 0;
    double late_depth = 0;
  };
  /** Bounds of one footstep, measured from the support foot: m, rad. */
  struct StepLimits {
    double max_forward = 0;
    double max_backward = 0;
    double max_outward = 0;
    double min_foot_separation = 0;
    double max_turn_outward = 0;
    double max_turn_inward = 0;
    double turn_inward_without_spread = 0;
    double square_distance = 0;
  };
  /** Velocity of the steps: change per step, m/s and rad/s; exponent; 1/s; m; lags in s and the
   * fractions of the greatest velocity, and of the greatest turn, at the longer one; fraction of
   * both with a dead foot sensor. */
  struct Velocity {
    double max_change_vx = 0;
    double max_change_vy = 0;
    double max_change_wz = 0;
    double envelope_exponent = 0;
    double path_gain = 0;
    double max_path_offset = 0;
    double full_speed_lag = 0;
    double slow_speed_lag = 0;
    double slow_speed = 0;
    double slow_turning = 0;
    double slow_envelope_exponent = 0;
    double dead_sensor_speed = 0;
  };
  /** Control law of the zero moment point: gain and range on the sole, m. */
  struct Zmp {
    double gain = 0;
    double reach_forward = 0;
    double reach_backward = 0;
    double reach_sideways = 0;
  };
  /** Feedback of the measured center of mass: s, 1/s, dimensionless gains, bounds in m. */
  struct Feedback {
    double initial_lag = 0;
    double com_position_gain = 0;
    double com_velocity_gain = 0;
    double footstep_gain = 0;
    double timing_gain = 0;
    double ankle_dcm_gain = 0;
    double bias_gain = 0;
    double max_bias = 0;
    double max_com_offset = 0;
    double com_offset_gain = 0;
  };
  /** Feedback of the torso's angular velocity, s, and tilt, dimensionless, to joint angles. */
  struct Orientation {
    double gyro_ankle_pitch = 0;
    double gyro_ankle_roll = 0;
    double gyro_hip_pitch = 0;
    double gyro_hip_roll = 0;
    double tilt_ankle_pitch = 0;
    double tilt_ankle_roll = 0;
  };
  /** Feedback of the torso's angular velocity while the robot stands: s, s, rad/s. */
  struct Standing {
    double ankle_pitch = 0;
    double hip_pitch = 0;
    double least_rate = 0;
  };
  /** Feedforward to the position servos: s, dimensionless scales. */
  struct Servo {
    double lead_time = 0;
    double torque_scale = 0;
    double velocity_scale = 0;
    double inertia_scale = 0;
  };
  /** Kick during the walk, m. */
  struct Kick {
    double ball_distance = 0;
    double swing_reach = 0;
    double swing_lift = 0;
  };
  /** Arms: swing in rad per m of stride. */
  struct Arms {
    double swing_gain = 0;
  };

  Timing timing;
  Stance stance;
  Swing swing;
  StepLimits step_limits;
  Velocity velocity;
  Zmp zmp;
  Feedback feedback;
  Orientation orientation;
  Standing standing;
  Servo servo;
  Kick kick;
  Arms arms;

  /** One entry of the file: where its value is stored, and the range of the tuner. */
  struct Parameter {
    /** "GROUP.KEY". */
    std::string name;
    double& (*in)(Gait&);
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
