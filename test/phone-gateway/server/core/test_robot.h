#pragma once

#include "remote.pb.h"

namespace nao::gateway {

/** A robot of four joints, for tests that need no real one. */
inline naoremote::RobotDescription make_test_robot() {
  naoremote::RobotDescription robot;
  robot.set_name("NAO");
  robot.set_model("test");
  robot.set_max_vx(0.2);
  robot.set_min_vx(-0.1);
  robot.set_max_vy(0.15);
  robot.set_max_wz(1.0);
  for (const char* name : {"HeadYaw", "HeadPitch", "LShoulderRoll", "LHand"}) {
    naoremote::Joint* joint = robot.add_joints();
    joint->set_name(name);
    joint->set_lower(-1);
    joint->set_upper(1);
    joint->set_max_velocity(5);
  }
  for (const char* name : {"Stand", "Crouch"}) robot.add_postures(name);
  for (const char* name : {"wave", "kick-left"}) robot.add_actions(name);
  for (const char* name : {"top", "bottom"}) robot.add_cameras(name);
  naoremote::JointGroup* head = robot.add_joint_groups();
  head->set_name("head");
  head->set_yaw_joint("HeadYaw");
  head->set_pitch_joint("HeadPitch");
  naoremote::JointGroup* hand = robot.add_joint_groups();
  hand->set_name("left hand");
  hand->set_pitch_joint("LHand");
  for (const char* name : {"left-eye", "chest"}) robot.add_lights()->set_name(name);
  return robot;
}

}  // namespace nao::gateway
