#pragma once

#include <memory>
#include <string>

#include "robot_model/robot_model.h"
#include "test/support/temporary_folder.h"

namespace nao::sim {

/** Reads a robot from a URDF text whose root is called "torso", as small as physics tests want it.
 * @param motors   Lines of robot.yaml's `motors`, "  {}" for none.
 * @param motor    Fields of the motor type "motor".
 * @param outline  Lower side of the torso, which is its sole.
 * @param posture  Joints of its one posture, "Start". */
inline std::shared_ptr<const RobotModel> make_robot(const std::string& urdf,
                                                    const std::string& motors,
                                                    const std::string& motor,
                                                    const std::string& outline,
                                                    const std::string& posture) {
  const TemporaryFolder folder;
  write_text(folder.path() / "test.urdf", urdf);
  write_text(folder.path() / "robot.yaml",
             "urdf: test.urdf\nmotor_types:\n  motor: " + motor + "\nmotors: " + motors +
                 "\ncoupled_limits: []\njoint_groups: []\ncameras: []\n"
                 "inertial_unit: {accelerometer: torso, gyroscope: torso}\nfoot_sensors: []\n"
                 "soles:\n  left: {link: torso, outline: " +
                 outline + "}\n  right: {link: torso, outline: " + outline +
                 "}\ncontact_clusters: []\n"
                 "walk_limits: {forward: 0, backward: 0, sideways: 0, turning: 0}\nactions: []\n");
  write_text(
      folder.path() / "postures.yaml",
      "postures:\n  - {name: Start, family: standing, source: test, joints: " + posture + "}\n");
  return std::make_shared<const RobotModel>(RobotModel::load(folder.path()));
}

inline const char* ideal_motor() {
  return "{continuous_torque: 3, no_load_velocity: 1.0e+9, reflected_inertia: 0, dry_friction: 0, "
         "viscous_friction: 0, stiffness_gain: 100, damping_gain: 1}";
}

/** A block of 1 kg, 0.2 x 0.2 x 0.05 m, its frame in the middle of its lower side. */
inline std::shared_ptr<const RobotModel> make_block() {
  return make_robot(R"(<robot name="block"><link name="torso">
    <inertial><origin xyz="0 0 0.025"/><mass value="1"/>
      <inertia ixx="0.00354" iyy="0.00354" izz="0.00667" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision name="block"><origin xyz="0 0 0.025"/>
      <geometry><box size="0.2 0.2 0.05"/></geometry></collision>
    </link></robot>)",
                    "{}", ideal_motor(), "[[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]",
                    "{}");
}

/** A rod of 0.5 kg that swings about y below the torso: centre of mass 0.3 m below the axis,
 * 0.01 kg m^2 about it. @param motor  Its motor type. */
inline std::shared_ptr<const RobotModel> make_pendulum(const std::string& motor) {
  return make_robot(R"(<robot name="pendulum"><link name="torso">
    <inertial><mass value="1"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="Swing" type="revolute"><parent link="torso"/><child link="rod"/>
      <axis xyz="0 1 0"/><limit lower="-1.5" upper="1.5" effort="3" velocity="6"/></joint>
    <link name="rod"><inertial><origin xyz="0 0 -0.3"/><mass value="0.5"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
    </robot>)",
                    "{Swing: motor}", motor, "[[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1]]",
                    "{Swing: 0}");
}

}  // namespace nao::sim
