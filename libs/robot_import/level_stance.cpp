#include "robot_import/level_stance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "kinematics/kinematics.h"

namespace nao {
namespace {

using Eigen::Isometry3d;
using Eigen::VectorXd;

constexpr int kNumRounds = 60;
// Weights of a foot's heading and of the distance from the angles 0, relative to its tilt.
constexpr double kHeadingWeight = 0.2;
constexpr double kRestWeight = 0.02;
// Angle from which the search starts for a knee, rad.
constexpr double kStartBend = 0.3;
// Weight of the center of mass over the middle of the soles, relative to their height.
constexpr double kAheadWeight = 0.3;
// Errors of a posture that is accepted: tilt of a sole, rad; height, fraction of the robot's; place
// of the center of mass, fraction of the sole's half length.
constexpr double kMaxTilt = 0.03;
constexpr double kMaxOff = 0.05;
constexpr double kMaxAhead = 0.6;

class LevelStance {
 public:
  LevelStance(const RobotModel& model, double bend)
      : model_(model), kinematics_(model), position_(model.num_motors(), 0.0) {
    for (int motor = 0; motor < model.num_motors(); ++motor) {
      position_[motor] = model.clip_to_limits(motor, 0, position_);
    }
    std::set<int> motors;
    for (const LegDescription& leg : model.legs()) {
      for (const int joint : leg.joints) motors.insert(model.motor_of(joint));
    }
    motors.erase(-1);
    motors_.assign(motors.begin(), motors.end());
    rest_ = position_;
    kinematics_.update(position_);
    start_ = {kinematics_.left_sole(), kinematics_.right_sole()};
    height_ = -0.5 * (start_[0].translation().z() + start_[1].translation().z());
    lift_ = bend * height_;
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : model.left_sole_outline()) box.extend(corner);
    center_ = box.center().x();
    bend_knees();
    half_length_ = 0.5 * box.sizes().x();
  }

  std::optional<std::vector<double>> solve() {
    if (motors_.empty() || !(height_ > 0)) return std::nullopt;
    const auto count = static_cast<Eigen::Index>(motors_.size());
    double damping = 1e-3;
    VectorXd error = errors();
    for (int round = 0; round < kNumRounds; ++round) {
      Eigen::MatrixXd jacobian(error.size(), count);
      const std::vector<double> at = position_;
      for (Eigen::Index i = 0; i < count; ++i) {
        constexpr double kStep = 1e-5;
        position_[motors_[i]] += kStep;
        jacobian.col(i) = (errors() - error) / kStep;
        position_ = at;
      }
      const Eigen::MatrixXd normal =
          jacobian.transpose() * jacobian + damping * Eigen::MatrixXd::Identity(count, count);
      const VectorXd step = normal.ldlt().solve(-jacobian.transpose() * error);
      for (Eigen::Index i = 0; i < count; ++i) {
        const int motor = motors_[i];
        position_[motor] = model_.clip_to_limits(motor, at[motor] + step[i], at);
      }
      const VectorXd next = errors();
      const bool is_better = next.squaredNorm() < error.squaredNorm();
      damping = is_better ? std::max(1e-9, 0.3 * damping) : 10 * damping;
      if (is_better) {
        error = next;
      } else {
        position_ = at;
      }
    }
    if (!is_good(error)) return std::nullopt;
    return position_;
  }

 private:
  static constexpr int kPerSole = 6;

  // A stretched knee is a singularity, at which nothing says which way it bends: its limits do.
  void bend_knees() {
    const auto poses = model_.link_poses(rest_);
    for (const int motor : motors_) {
      const Joint& joint = model_.motor_joint(motor);
      const double pitch = (poses[joint.child_link].linear() * joint.axis).y();
      const double middle = 0.5 * (joint.lower + joint.upper);
      if (std::abs(pitch) < 0.7 || std::abs(middle) < kStartBend) continue;
      position_[motor] = model_.clip_to_limits(motor, std::copysign(kStartBend, middle), rest_);
    }
  }

  // For each sole: height, place ahead and aside, tilt about x and y, heading; then the distances
  // from the angles 0. Places in units of the height.
  VectorXd errors() {
    kinematics_.update(position_);
    const std::array<Isometry3d, 2> soles = {kinematics_.left_sole(), kinematics_.right_sole()};
    const Eigen::Vector3d com = kinematics_.center_of_mass();
    VectorXd error(2 * kPerSole + static_cast<Eigen::Index>(motors_.size()));
    for (int side = 0; side < 2; ++side) {
      const Eigen::Vector3d off = soles[side].translation() - start_[side].translation();
      const Eigen::Matrix3d& r = soles[side].linear();
      const double ahead = com.x() - (soles[side] * Eigen::Vector3d(center_, 0, 0)).x();
      error.segment<kPerSole>(kPerSole * side) << (off.z() - lift_) / height_,
          kAheadWeight * ahead / height_, off.y() / height_, r(2, 1), r(2, 0),
          kHeadingWeight * r(1, 0);
    }
    for (size_t i = 0; i < motors_.size(); ++i) {
      error[2 * kPerSole + static_cast<Eigen::Index>(i)] =
          kRestWeight * (position_[motors_[i]] - rest_[motors_[i]]);
    }
    return error;
  }

  bool is_good(const VectorXd& error) {
    for (int side = 0; side < 2; ++side) {
      const auto of = error.segment<kPerSole>(kPerSole * side);
      // The feet may come nearer to each other where the ankles cannot roll.
      if (std::abs(of[0]) > kMaxOff || of.segment<2>(3).norm() > kMaxTilt ||
          std::abs(of[1]) * height_ > kMaxAhead * kAheadWeight * half_length_) {
        return false;
      }
    }
    return std::abs(error[0] - error[kPerSole]) < 0.1 * kMaxOff;
  }

  const RobotModel& model_;
  Kinematics kinematics_;
  std::vector<double> position_;
  std::vector<double> rest_;
  std::vector<int> motors_;
  std::array<Isometry3d, 2> start_;
  double height_ = 0;
  double lift_ = 0;
  double center_ = 0;
  double half_length_ = 0;
};

}  // namespace

std::optional<std::vector<double>> find_level_stance(const RobotModel& model, double bend) {
  return LevelStance(model, bend).solve();
}

}  // namespace nao
