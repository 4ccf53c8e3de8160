#pragma once

#include <string>

#include "phone-gateway/server/phone_robot.h"

namespace nao {

/** A robot of four joints, for tests that need no real one. */
inline PhoneRobot make_test_robot() {
  PhoneRobot robot;
  robot.walk_limits = {0.2, 0.1, 0.15, 1.0};
  naoremote::RobotDescription& description = robot.description;
  description.set_name("TEST");
  for (const char* name : {"HeadYaw", "HeadPitch", "LShoulderRoll", "LHand"}) {
    naoremote::Joint* joint = description.add_joints();
    joint->set_name(name);
    joint->set_lower(-1);
    joint->set_upper(1);
    joint->set_max_velocity(5);
  }
  for (const char* name : {"Stand", "Crouch"}) description.add_postures(name);
  for (const char* name : {"top", "bottom"}) description.add_cameras(name);
  for (const char* name : {"wave", "kick-left"}) description.add_actions(name);
  naoremote::JointGroup* head = description.add_joint_groups();
  head->set_name("head");
  head->set_yaw_joint("HeadYaw");
  head->set_pitch_joint("HeadPitch");
  naoremote::JointGroup* hand = description.add_joint_groups();
  hand->set_name("left hand");
  hand->set_pitch_joint("LHand");
  return robot;
}

}  // namespace nao
