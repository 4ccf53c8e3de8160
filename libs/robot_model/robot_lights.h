#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** A group of lights that light_command_t names, and where it is on the robot. */
struct RobotLight {
  /** A round surface that emits light. */
  struct Disc {
    /** In the link's frame, m. */
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    /** Unit vector along which it shines, in the link's frame. */
    Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
    /** m; a ring has an inner radius above 0. */
    double radius = 0;
    double inner_radius = 0;
  };

  std::string name;
  /** Its name for people, by language ("en"). */
  std::map<std::string, std::string> labels;
  /** It is lit while the robot speaks. */
  bool is_eye = false;
  /** Index of the link that carries it. */
  int link = -1;
  std::vector<Disc> discs;
};

/** Reads lights.yaml of a robot's folder. @return No lights if there is no such file, or with
 * a warning if something in it is wrong: a robot is driven without. */
std::vector<RobotLight> load_robot_lights(const RobotModel& model);

std::vector<std::string> names_of(const std::vector<RobotLight>& lights);

}  // namespace nao
