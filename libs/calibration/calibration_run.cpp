#include "calibration/calibration_run.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"

namespace nao {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

// Speed of the joints, fraction of the maximum. Chosen: slow enough that the robot does not sway.
constexpr double kSpeed = 0.1;
// Time until the robot stands still after a move, and time for which it is then measured, s.
// Chosen: a sway decays within 0.3 s; 40 readings attenuate their noise to a sixth.
constexpr double kSettlingTime = 0.4;
constexpr double kMeasuringTime = 0.5;
// Number of commands that may fail, such as a turn that ended in a fall after which the robot got
// up.
constexpr int kMaxFaults = 3;

/** Displacement of the torso from its place in the ready posture: m, rad. */
struct TorsoShift {
  double x;
  double y;
  double z;
  double roll;
  double pitch;
};

// Chosen: the CoM's projection stays 2 cm within the edges of the soles with errors of a degree.
// Shifts to the sides load one foot with four fifths of the weight; heights and tilts of the torso
// change the levers of the joints' and the inertial unit's errors.
constexpr TorsoShift kShifts[] = {
    {0, 0, 0, 0, 0},     {0, 0.03, 0, 0, 0},      {0, -0.03, 0, 0, 0},      {0.02, 0, 0, 0, 0},
    {-0.02, 0, 0, 0, 0}, {0, 0.025, -0.03, 0, 0}, {0, -0.025, -0.03, 0, 0}, {0, 0, 0, 0.08, 0},
    {0, 0, 0, -0.08, 0}, {0, 0, -0.01, 0, 0.12},  {0, 0, -0.01, 0, -0.08},
};

/** Angles of all motors with the torso displaced over the soles of the ready posture. Shifts that
 * the legs do not reach are left out. */
// A list of poses that moves the weight and changes the lever arms of all errors; without it the
// errors of joints and inertial unit could not be distinguished.
std::vector<std::vector<double>> plan_poses(const RobotModel& model) {
  const LegKinematics legs(model);
  Kinematics kinematics(model);
  const std::vector<double>& ready = model.ready_posture().position;
  kinematics.update(ready);
  std::vector<std::vector<double>> poses;
  for (const TorsoShift& shift : kShifts) {
    Isometry3d moved = Isometry3d::Identity();
    moved.translation() = Vector3d(shift.x, shift.y, shift.z);
    moved.linear() =
        (AngleAxisd(shift.roll, Vector3d::UnitX()) * AngleAxisd(shift.pitch, Vector3d::UnitY()))
            .toRotationMatrix();
    // The soles stay where they are; the torso moves over them.
    const Isometry3d to_moved = moved.inverse();
    const LegsSolution solution =
        legs.solve_both(to_moved * kinematics.left_sole(), to_moved * kinematics.right_sole());
    if (!solution.is_reachable) continue;
    std::vector<double> position = ready;
    legs.write(Leg::kLeft, solution.left, position);
    legs.write(Leg::kRight, solution.right, position);
    poses.push_back(std::move(position));
  }
  return poses;
}

}  // namespace

CalibrationRun::CalibrationRun(const RobotModel& model, int num_stations)
    : model_(&model), estimator_(model) {
  for (const LegDescription& leg : model.legs()) {
    for (const int joint : leg.joints) {
      const int motor = model.motor_of(joint);
      if (motor >= 0 && std::find(motors_.begin(), motors_.end(), motor) == motors_.end()) {
        motors_.push_back(motor);
      }
    }
  }
  const std::vector<std::vector<double>> poses = plan_poses(model);
  // Stations at equal turns: the slope of the room turns relative to the robot, its own errors do
  // not.
  for (int station = 0; station < num_stations; ++station) {
    if (station > 0) steps_.push_back({2 * M_PI / num_stations, {}});
    // The robot first stands upright, the posture in which turns begin.
    steps_.push_back({});
    for (const std::vector<double>& pose : poses) steps_.push_back({0, pose});
  }
  // It ends as it began.
  steps_.push_back({});
}

// One command at a time; the next one after end_command() and, for poses, the measurement.
std::optional<CalibrationCommand> CalibrationRun::next_command() {
  if (phase_ != Phase::kReady) return std::nullopt;
  phase_ = Phase::kMoving;
  const Step& step = steps_[step_];
  if (step.turn != 0) return MoveToCommand{0, 0, step.turn};
  if (step.position.empty()) return PostureCommand{model_->ready_posture().name, kSpeed};
  JointChangeCommand change;
  for (const int motor : motors_) {
    change.joint_names.push_back(model_->motor_names()[motor]);
    change.joint_position.push_back(step.position[motor]);
  }
  change.speed = kSpeed;
  // The weight stays within the soles (kShifts). The tipping guard refuses these poses: joints that
  // end at different times slightly tilt the soles during the move, and the guard counts only flat
  // soles.
  change.allow_tipping = true;
  return change;
}

void CalibrationRun::end_command(const std::string& fault) {
  if (phase_ != Phase::kMoving) return;
  const Step& step = steps_[step_];
  // A command that fails costs only its pose, up to kMaxFaults.
  if (!fault.empty() && ++num_faults_ > kMaxFaults) {
    fault_ = fault;
    phase_ = Phase::kDone;
    return;
  }
  if (step.turn != 0) {
    // The feet have moved, whether or not the turn was completed. A heading error by the missed
    // part of the turn matters little: the slope is one of three causes of a tilt.
    ++station_;
    heading_ += step.turn;
  }
  // Turns and the upright posture are not measured.
  if (step.turn != 0 || step.position.empty() || !fault.empty()) {
    advance();
    return;
  }
  phase_ = Phase::kSettling;
  time_ = 0;
}

void CalibrationRun::advance() {
  ++step_;
  phase_ = step_ < steps_.size() ? Phase::kReady : Phase::kDone;
}

// Called in every tick; only the phases after a move use the sample.
void CalibrationRun::measure(StandingSample sample, double dt) {
  time_ += dt;
  if (phase_ == Phase::kSettling && time_ >= kSettlingTime) {
    phase_ = Phase::kMeasuring;
    time_ = 0;
    mean_.reset();
  }
  if (phase_ != Phase::kMeasuring) return;
  sample.station = station_;
  sample.heading = heading_;
  mean_.add(sample);
  if (time_ < kMeasuringTime) return;
  estimator_.add(mean_.mean());
  advance();
}

double CalibrationRun::progress() const {
  return static_cast<double>(step_) / static_cast<double>(steps_.size());
}

}  // namespace nao
