#pragma once

#include <naolcm/world_truth_t.hpp>
#include <string>

#include "robot_model/robot_model.h"

namespace nao {

/** A world with one robot in a posture, its torso's origin at a height over the ground's origin.
 * @param height  m. */
inline naolcm::world_truth_t make_truth(const RobotModel& model, const std::string& posture,
                                        double height, const std::string& scene = "soccer") {
  naolcm::robot_truth_t robot{};
  robot.robot = "NAO";
  robot.position_torso_in_world[2] = height;
  robot.orientation_torso_in_world[0] = 1;
  robot.num_joints = model.num_motors();
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    robot.joint_names.push_back(model.motor_joint(motor).name);
  }
  robot.joint_position = model.find_posture(posture)->position;
  robot.joint_velocity.assign(model.num_motors(), 0);
  robot.joint_torque.assign(model.num_motors(), 0);

  naolcm::world_truth_t truth{};
  truth.utime = 1000000;
  truth.scene = scene;
  truth.num_robots = 1;
  truth.robots.push_back(robot);
  truth.has_ball = 1;
  truth.position_ball_in_world[0] = 1;
  truth.position_ball_in_world[2] = 0.05;
  truth.orientation_ball_in_world[0] = 1;
  return truth;
}

}  // namespace nao
