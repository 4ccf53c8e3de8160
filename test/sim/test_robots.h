#pragma once

#include <memory>
#include <string>

#include "robot_model/robot_model.h"
#include "test/support/temporary_folder.h"

namespace nao::sim {

/** Feet of a robot: links of the soles, and robot.yaml's `foot_sensors`. */
struct TestFeet {
  std::string left = "torso";
  std::string right = "torso";
  std::string sensors = "[]";
};

/** Reads a robot from a URDF text whose root is called "torso".
 * @param motors   Lines of robot.yaml's `motors`, "  {}" for none.
 * @param motor    Fields of the motor type "motor".
 * @param outline  Outline of each sole.
 * @param posture  Joints of its one posture, "Start". */
inline std::shared_ptr<const RobotModel> make_robot(
    const std::string& urdf, const std::string& motors, const std::string& motor,
    const std::string& outline, const std::string& posture, const TestFeet& feet = {}) {
  const TemporaryFolder folder;
  write_text(folder.path() / "test.urdf", urdf);
  write_text(folder.path() / "robot.yaml",
             "urdf: test.urdf\nmotor_types:\n  motor: " + motor + "\nmotors: " + motors +
                 "\ncoupled_limits: []\njoint_groups: []\ncameras: []\n"
                 "inertial_unit: {accelerometer: torso, gyroscope: torso}\nfoot_sensors: " +
                 feet.sensors + "\nsoles:\n  left: {link: " + feet.left + ", outline: " + outline +
                 "}\n  right: {link: " + feet.right + ", outline: " + outline +
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

/** A block, 0.2 x 0.2 x 0.05 m, its frame at the center of its lower side. @param mass  kg. */
inline std::shared_ptr<const RobotModel> make_block(const std::string& mass = "1") {
  return make_robot(R"(<robot name="block"><link name="torso">
    <inertial><origin xyz="0 0 0.025"/><mass value=")" +
                        mass +
                        R"("/>
      <inertia ixx="0.00354" iyy="0.00354" izz="0.00667" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision name="block"><origin xyz="0 0 0.025"/>
      <geometry><box size="0.2 0.2 0.05"/></geometry></collision>
    </link></robot>)",
                    "{}", ideal_motor(), "[[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]",
                    "{}");
}

/** A rod of 0.5 kg that swings about y below the torso: center of mass 0.3 m below the axis,
 * 0.01 kg m^2 about it. @param motor  Fields of its motor type. */
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

/** A torso of 1 kg on two feet of 0.1 kg, 0.1 m to the left and right of it: three force sensors in
 * the left foot, one in the right. */
inline std::shared_ptr<const RobotModel> make_biped_with_three_sensors() {
  const auto foot = [](const std::string& side, const std::string& y) {
    return "<joint name=\"" + side + "Ankle\" type=\"revolute\"><origin xyz=\"0 " + y +
           " -0.1\"/><parent link=\"torso\"/><child link=\"" + side +
           "Foot\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" effort=\"3\" "
           "velocity=\"6\"/></joint><link name=\"" +
           side +
           "Foot\"><inertial><mass value=\"0.1\"/><inertia ixx=\"0.0001\" iyy=\"0.0001\" "
           "izz=\"0.0001\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial><collision name=\"foot\">"
           "<geometry><box size=\"0.1 0.1 0.02\"/></geometry></collision></link>" +
           "<joint name=\"" + side +
           "SoleFixed\" type=\"fixed\"><origin xyz=\"0 0 -0.01\"/>"
           "<parent link=\"" +
           side + "Foot\"/><child link=\"" + side +
           "Sole\"/></joint>"
           "<link name=\"" +
           side + "Sole\"/>";
  };
  const auto sensor = [](const std::string& foot_link, const std::string& name,
                         const std::string& xyz) {
    return "<joint name=\"" + name + "Fixed\" type=\"fixed\"><origin xyz=\"" + xyz +
           "\"/><parent link=\"" + foot_link + "\"/><child link=\"" + name +
           "\"/></joint><link name=\"" + name + "\"/>";
  };
  return make_robot(
      R"(<robot name="biped"><link name="torso"><inertial><mass value="1"/>
      <inertia ixx="0.003" iyy="0.003" izz="0.003" ixy="0" ixz="0" iyz="0"/></inertial></link>)" +
          foot("L", "0.1") + foot("R", "-0.1") + sensor("LFoot", "LToe", "0.04 0 -0.01") +
          sensor("LFoot", "LHeelOut", "-0.04 0.03 -0.01") +
          sensor("LFoot", "LHeelIn", "-0.04 -0.03 -0.01") +
          sensor("RFoot", "RMiddle", "0 0 -0.01") + "</robot>",
      "{LAnkle: motor, RAnkle: motor}", ideal_motor(),
      "[[-0.05, -0.05], [0.05, -0.05], [0.05, 0.05], [-0.05, 0.05]]", "{LAnkle: 0, RAnkle: 0}",
      {"LSole", "RSole", "[LToe, LHeelOut, LHeelIn, RMiddle]"});
}

/** A block on so many spheres of 1 cm in a square grid. Each touches the floor except the first
 * two, which carry the soles: their points are the outlines at the height of the spheres' centers.
 */
inline std::shared_ptr<const RobotModel> make_bed_of_spheres(int spheres_a_side) {
  std::string urdf = R"(<robot name="bed"><link name="torso">
    <inertial><mass value="1"/>
      <inertia ixx="0.05" iyy="0.05" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>)";
  for (int i = 0; i < spheres_a_side; ++i) {
    for (int k = 0; k < spheres_a_side; ++k) {
      urdf += "<collision name=\"s" + std::to_string(i) + "_" + std::to_string(k) +
              "\"><origin xyz=\"" + std::to_string(0.03 * i) + " " + std::to_string(0.03 * k) +
              " 0\"/><geometry><sphere radius=\"0.01\"/></geometry></collision>";
    }
  }
  return make_robot(urdf + "</link></robot>", "{}", ideal_motor(),
                    "[[-0.01, -0.01], [0.01, -0.01], [0, 0.01]]", "{}");
}

}  // namespace nao::sim
