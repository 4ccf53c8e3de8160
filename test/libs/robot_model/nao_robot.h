#pragma once

#include <Eigen/Dense>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "common/data_path.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Tolerance of lengths that the vendor publishes in tenths of a millimeter, m. */
inline constexpr double kExact = 1e-9;

inline const RobotModel& nao_robot() {
  static const RobotModel robot = RobotModel::load(data_path() / "robots" / "nao");
  return robot;
}

inline std::vector<double> zero_posture() {
  return std::vector<double>(nao_robot().num_motors(), 0.0);
}

inline std::vector<double> posture(const std::string& name) {
  return nao_robot().find_posture(name)->position;
}

inline Eigen::Isometry3d pose_of(const std::string& link, const std::vector<double>& position) {
  return nao_robot().link_poses(position)[nao_robot().find_link(link)];
}

/** Name of the mirrored link or joint: "LFoot" for "RFoot"; the same name if it has no side. */
inline std::string counterpart(std::string name) {
  if (name.size() > 1 && std::isupper(name[1]) != 0) {
    if (name[0] == 'L' || name[0] == 'R') {
      name[0] = name[0] == 'L' ? 'R' : 'L';
    }
  }
  for (const auto& [from, to] : {std::pair{"Left", "Right"}, std::pair{"Right", "Left"}}) {
    const size_t at = name.find(from);
    if (at != std::string::npos) {
      return name.replace(at, std::string(from).size(), to);
    }
  }
  // Foot sensors: outer ones mirror outer ones.
  if (name.find("Fsr") != std::string::npos) {
    name.replace(5, 1, name[5] == 'L' ? "R" : "L");
  }
  return name;
}

/** Mirrors at the xz plane. */
inline const Eigen::DiagonalMatrix<double, 3> kMirror(1, -1, 1);

inline Eigen::Isometry3d mirrored(const Eigen::Isometry3d& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = kMirror * pose.translation();
  result.linear() = kMirror * pose.linear() * kMirror;
  return result;
}

}  // namespace nao
