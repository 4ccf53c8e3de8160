#include "inspection/robot_transforms.h"

#include <cmath>

namespace nao {

void RobotTransforms::append_moving(const std::vector<double>& position, const std::string& prefix,
                                    std::vector<NamedTransform>& transforms) const {
  const std::vector<double> angles = model_.joint_positions(position);
  for (size_t i = 0; i < angles.size(); ++i) {
    const Joint& joint = model_.joints()[i];
    if (joint.kind == Joint::Kind::kFixed) continue;
    transforms.push_back({prefix + model_.links()[joint.parent_link].name,
                          prefix + model_.links()[joint.child_link].name,
                          joint.pose_in_parent * Eigen::AngleAxisd(angles[i], joint.axis)});
  }
}

void RobotTransforms::append_fixed(const std::string& prefix,
                                   std::vector<NamedTransform>& transforms) const {
  for (const Joint& joint : model_.joints()) {
    if (joint.kind != Joint::Kind::kFixed) continue;
    transforms.push_back({prefix + model_.links()[joint.parent_link].name,
                          prefix + model_.links()[joint.child_link].name, joint.pose_in_parent});
  }
  // A camera's link has x along the view and z up: docs/frames.md.
  Eigen::Isometry3d optical = Eigen::Isometry3d::Identity();
  optical.rotate(Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitZ()) *
                 Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()));
  for (const CameraModel& camera : model_.cameras()) {
    const std::string link = prefix + model_.links()[camera.link].name;
    transforms.push_back({link, optical_frame(link), optical});
  }
}

}  // namespace nao
