#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "robot_model/robot_description.h"
#include "robot_model/robot_mechanism.h"

namespace nao {

/** The description of a robot in data/robots/NAME/: its mechanism, limbs, sensors, postures,
 * actions.
 *
 * Names, joint numbers, limits and frames come only from here. It is a read-only record of
 * robot.yaml, the URDF, postures.yaml and labels.yaml. RobotModelReader fills it. */
class RobotModel : public RobotMechanism {
 public:
  /** Reads robot.yaml, the URDF that it names, postures.yaml and, if there is one, labels.yaml from
   * a folder.
   * @throws ModelError  with the file, the element and what is wrong with it. */
  static RobotModel load(const std::filesystem::path& folder);
  /** As load(), from a folder of robots/ in data_path(): "nao". */
  static RobotModel find(const std::string& name);

  const std::string& name() const { return name_; }
  const std::filesystem::path& folder() const { return folder_; }
  /** Absolute path of the URDF file, which robot.yaml's `urdf` names; it lies in folder(). */
  const std::filesystem::path& urdf_file() const { return urdf_file_; }

  const std::vector<Posture>& postures() const { return postures_; }
  /** @return nullptr if there is none of that name. */
  const Posture* find_posture(const std::string& name) const;
  const MotionReferences& references() const { return references_; }
  /** The posture in which walks and actions begin. @throws ModelError  if the robot has none. */
  const Posture& ready_posture() const;

  const std::vector<JointGroup>& joint_groups() const { return joint_groups_; }
  const std::vector<CameraModel>& cameras() const { return cameras_; }
  const WalkLimits& walk_limits() const { return walk_limits_; }
  /** Actions that action_command_t may name. */
  const std::vector<Action>& actions() const { return actions_; }
  /** @return nullptr if there is none of that name or kind. */
  const Action* find_action(const std::string& name) const;
  const Action* find_action(Action::Kind kind, Side side = Side::kNone) const;
  const std::vector<Label>& labels() const { return labels_; }

  /** Left, right. */
  const std::array<LegDescription, 2>& legs() const { return legs_; }
  /** Left, right; empty for a robot without arms. */
  const std::vector<ArmDescription>& arms() const { return arms_; }
  const Symmetry& symmetry() const { return symmetry_; }
  /** Links of the soles' frames, and the soles' outlines. */
  int left_sole() const { return legs_[0].sole; }
  int right_sole() const { return legs_[1].sole; }
  const std::vector<Eigen::Vector2d>& left_sole_outline() const { return legs_[0].outline; }
  const std::vector<Eigen::Vector2d>& right_sole_outline() const { return legs_[1].outline; }

  /** Foot force sensors of both feet: link indices of their frames, in robot.yaml's order. */
  const std::vector<int>& foot_sensors() const { return foot_sensors_; }
  /** Links of the inertial unit's frames. */
  int accelerometer() const { return accelerometer_; }
  int gyroscope() const { return gyroscope_; }

 private:
  friend class RobotModelReader;

  std::string name_;
  std::filesystem::path folder_;
  std::filesystem::path urdf_file_;
  std::vector<Posture> postures_;
  MotionReferences references_;
  std::vector<JointGroup> joint_groups_;
  std::vector<CameraModel> cameras_;
  WalkLimits walk_limits_;
  std::vector<Action> actions_;
  std::vector<Label> labels_;
  std::array<LegDescription, 2> legs_;
  std::vector<ArmDescription> arms_;
  Symmetry symmetry_;
  std::vector<int> foot_sensors_;
  int accelerometer_ = -1;
  int gyroscope_ = -1;
};

}  // namespace nao
