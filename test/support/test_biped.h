#pragma once

#include <array>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>

#include "robot_model/robot_model.h"
#include "test/support/temporary_folder.h"

namespace nao {

/** Dimensions of a humanoid that a test generates: m, kg. */
struct TestBiped {
  /** Axes of the hip from the root: "yxz" is pitch, roll, yaw. */
  std::string hip = "zxy";
  /** Angle by which hip axes x and z are turned about y, rad. */
  double hip_tilt = 0;
  /** Axes of the ankle, from the shank. */
  std::string ankle = "yx";
  /** A pitch joint in the middle of the shank. */
  bool has_second_knee = false;
  double thigh = 0.2;
  double shank = 0.2;
  double foot_height = 0.05;
  double hip_width = 0.1;
  double mass = 10;
  /** Offsets that keep the leg from a closed form: between the hip's axes, of the knee ahead of the
   * leg's line, between the ankle's axes. */
  double hip_offset = 0;
  double knee_offset = 0;
  double ankle_offset = 0;
  bool has_waist = false;
  bool has_arms = true;
  /** Four force sensors in the sole's corners. */
  bool has_foot_sensors = false;
};

namespace biped {

inline std::string link(const std::string& name, double mass, double com_z, double size) {
  const double inertia = mass * size * size / 6;
  std::ostringstream text;
  text.precision(17);
  text << "<link name=\"" << name << "\"><inertial><origin xyz=\"0 0 " << com_z
       << "\"/><mass value=\"" << mass << "\"/><inertia ixx=\"" << inertia << "\" iyy=\"" << inertia
       << "\" izz=\"" << inertia << "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n";
  return text.str();
}

inline std::string joint(const std::string& name, const std::string& parent,
                         const std::string& child, const std::array<double, 3>& origin,
                         char direction, double lower, double upper, double effort,
                         double tilt = 0) {
  const double along = std::cos(tilt);
  const double across = std::sin(tilt);
  std::ostringstream text;
  text.precision(17);
  std::ostringstream axis;
  axis.precision(17);
  if (direction == 'x') axis << along << " 0 " << across;
  if (direction == 'y') axis << "0 1 0";
  if (direction == 'z') axis << 0 - across << " 0 " << along;
  text << "<joint name=\"" << name << "\" type=\"revolute\"><parent link=\"" << parent
       << "\"/><child link=\"" << child << "\"/><origin xyz=\"" << origin[0] << " " << origin[1]
       << " " << origin[2] << "\"/><axis xyz=\"" << axis.str() << "\"/><limit lower=\"" << lower
       << "\" upper=\"" << upper << "\" effort=\"" << effort << "\" velocity=\"12\"/></joint>\n";
  return text.str();
}

}  // namespace biped

/** The URDF of a humanoid: root "trunk", soles "left_sole" and "right_sole", hands "left_hand" and
 * "right_hand", joints "left_knee" and so on. */
inline std::string make_biped_urdf(const TestBiped& dimensions) {
  using biped::joint;
  using biped::link;
  const double size = dimensions.thigh;
  const double torque = 6 * dimensions.mass * (dimensions.thigh + dimensions.shank);
  std::ostringstream text;
  text.precision(17);
  text << "<robot name=\"biped\">\n" << link("trunk", 0.5 * dimensions.mass, 0.5 * size, size);
  const std::string pelvis = dimensions.has_waist ? "pelvis" : "trunk";
  if (dimensions.has_waist) {
    text << joint("waist", "trunk", "pelvis", {0, 0, -0.1 * size}, 'z', -1.5, 1.5, torque)
         << link("pelvis", 0.05 * dimensions.mass, 0, 0.5 * size);
  }
  for (const std::string side : {"left", "right"}) {
    const double sign = side == "left" ? 1 : -1;
    const auto name = [&](const std::string& part) { return side + "_" + part; };
    std::string parent = pelvis;
    std::array<double, 3> origin = {0, sign * dimensions.hip_width / 2, -0.1 * size};
    for (size_t i = 0; i < dimensions.hip.size(); ++i) {
      const char axis = dimensions.hip[i];
      std::string part = axis == 'x' ? "hip_roll" : axis == 'y' ? "hip_pitch" : "hip_yaw";
      if (dimensions.hip.find(axis) < i) part += "_2";
      text << joint(name(part), parent, name(part + "_link"), origin, axis, axis == 'y' ? -2 : -1,
                    axis == 'y' ? 1.5 : 1, torque, dimensions.hip_tilt)
           << link(name(part + "_link"), 0.02 * dimensions.mass, -0.05 * size, 0.3 * size);
      parent = name(part + "_link");
      origin = {0, 0, -dimensions.hip_offset};
    }
    origin = {dimensions.knee_offset, 0, -dimensions.thigh};
    text << joint(name("knee"), parent, name("shank"), origin, 'y', 0, 2.3, torque)
         << link(name("shank"), 0.06 * dimensions.mass, -0.5 * dimensions.shank, size);
    parent = name("shank");
    origin = {-dimensions.knee_offset, 0, -dimensions.shank};
    if (dimensions.has_second_knee) {
      origin[2] *= 0.5;
      text << joint(name("second_knee"), parent, name("lower_shank"), origin, 'y', -0.5, 0.5,
                    torque)
           << link(name("lower_shank"), 0.02 * dimensions.mass, -0.2 * size, 0.5 * size);
      parent = name("lower_shank");
      origin[0] = 0;
    }
    for (size_t i = 0; i < dimensions.ankle.size(); ++i) {
      const bool is_pitch = dimensions.ankle[i] == 'y';
      const bool is_last = i + 1 == dimensions.ankle.size();
      const std::string child = name(is_last ? "foot" : "ankle");
      text << joint(name(is_pitch ? "ankle_pitch" : "ankle_roll"), parent, child, origin,
                    dimensions.ankle[i], is_pitch ? -1.2 : -0.7, is_pitch ? 1 : 0.7, torque);
      if (!is_last) text << link(child, 0.01 * dimensions.mass, 0, 0.2 * size);
      parent = child;
      origin = {0, 0, -dimensions.ankle_offset};
    }
    if (dimensions.ankle.empty()) {
      text << "<joint name=\"" << name("foot_mount") << "\" type=\"fixed\"><parent link=\""
           << parent << "\"/><child link=\"" << name("foot") << "\"/><origin xyz=\"" << origin[0]
           << " 0 " << origin[2] << "\"/></joint>\n";
    }
    std::ostringstream foot;
    foot.precision(17);
    foot << "<origin xyz=\"" << 0.1 * size << " 0 " << -0.75 * dimensions.foot_height
         << "\"/><geometry><box size=\"" << 0.6 * size << " " << 0.3 * size << " "
         << 0.5 * dimensions.foot_height << "\"/></geometry>";
    const std::string body =
        link(name("foot"), 0.02 * dimensions.mass, -0.5 * dimensions.foot_height, 0.4 * size);
    text << body.substr(0, body.find("</link>")) << "<collision name=\"sole\">" << foot.str()
         << "</collision></link>\n<joint name=\"" << name("sole_mount")
         << "\" type=\"fixed\"><parent link=\"" << name("foot") << "\"/><child link=\""
         << name("sole") << "\"/><origin xyz=\"0 0 " << -dimensions.foot_height
         << "\"/></joint>\n<link name=\"" << name("sole") << "\"/>\n";
    for (int corner = 0; dimensions.has_foot_sensors && corner < 4; ++corner) {
      const std::string sensor = name("force_" + std::to_string(corner));
      text << "<joint name=\"" << sensor << "_mount\" type=\"fixed\"><parent link=\""
           << name("foot") << "\"/><child link=\"" << sensor << "\"/><origin xyz=\""
           << (corner < 2 ? 0.35 : -0.15) * size << " " << (corner % 2 == 0 ? 0.12 : -0.12) * size
           << " " << -dimensions.foot_height << "\"/></joint>\n<link name=\"" << sensor << "\"/>\n";
    }
    if (!dimensions.has_arms) continue;
    text << joint(name("shoulder_pitch"), "trunk", name("shoulder"),
                  {0, sign * 0.8 * dimensions.hip_width, size}, 'y', -2, 2, 0.2 * torque)
         << link(name("shoulder"), 0.01 * dimensions.mass, 0, 0.2 * size)
         << joint(name("shoulder_roll"), name("shoulder"), name("upper_arm"),
                  {0, sign * 0.1 * size, 0}, 'x', sign > 0 ? -0.3 : -1.5, sign > 0 ? 1.5 : 0.3,
                  0.2 * torque)
         << link(name("upper_arm"), 0.02 * dimensions.mass, -0.3 * size, 0.3 * size)
         << joint(name("elbow"), name("upper_arm"), name("forearm"), {0, 0, -0.6 * size}, 'y', -2,
                  0.1, 0.2 * torque)
         << link(name("forearm"), 0.02 * dimensions.mass, -0.3 * size, 0.3 * size)
         << "<joint name=\"" << name("hand_mount") << "\" type=\"fixed\"><parent link=\""
         << name("forearm") << "\"/><child link=\"" << name("hand") << "\"/><origin xyz=\"0 0 "
         << -0.6 * size << "\"/></joint>\n<link name=\"" << name("hand") << "\"/>\n";
  }
  text << "</robot>\n";
  return text.str();
}

/** Reads the humanoid from files with no more than a robot needs. @param urdf  As it may have been
 * changed. @param postures  The content of postures.yaml. */
inline RobotModel make_biped(const TestBiped& dimensions, const std::string& urdf,
                             const std::string& postures = "postures: []\n") {
  const TemporaryFolder folder;
  write_text(folder.path() / "biped.urdf", urdf);
  std::ostringstream outline;
  const double ahead = 0.4 * dimensions.thigh;
  const double aside = 0.15 * dimensions.thigh;
  outline << "[[" << -0.5 * ahead << ", " << -aside << "], [" << ahead << ", " << -aside << "], ["
          << ahead << ", " << aside << "], [" << -0.5 * ahead << ", " << aside << "]]";
  write_text(folder.path() / "robot.yaml",
             "urdf: biped.urdf\ninertial_unit: {accelerometer: trunk, gyroscope: trunk}\nsoles:\n"
             "  left: {link: left_sole, outline: " +
                 outline.str() +
                 "}\n"
                 "  right: {link: right_sole, outline: " +
                 outline.str() + "}\n");
  write_text(folder.path() / "postures.yaml", postures);
  return RobotModel::load(folder.path());
}

inline RobotModel make_biped(const TestBiped& dimensions) {
  return make_biped(dimensions, make_biped_urdf(dimensions));
}

/** Humanoid with joints that follow others: in its own limb, with another joint between the two; in
 * the other arm; an ankle that follows the other leg's knee. */
inline RobotModel make_coupled_biped() {
  const TestBiped dimensions;
  std::string urdf = make_biped_urdf(dimensions);
  const auto couple = [&](const std::string& joint, const std::string& mimic) {
    const size_t at = urdf.find("</joint>", urdf.find("joint name=\"" + joint + "\""));
    urdf.insert(at, "<mimic joint=" + mimic + "/>");
  };
  couple("left_elbow", "\"left_shoulder_pitch\" multiplier=\"-0.7\" offset=\"-0.5\"");
  couple("right_elbow", "\"left_shoulder_roll\" multiplier=\"0.4\" offset=\"-0.6\"");
  couple("right_ankle_pitch", "\"left_knee\" multiplier=\"-0.5\"");
  const RobotModel model = make_biped(dimensions, urdf);
  std::string joints;
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    joints += (joints.empty() ? "" : ", ") + model.motor_joint(motor).name + ": 0";
  }
  return make_biped(
      dimensions, urdf,
      "postures: [{name: zero, family: standing, source: test, joints: {" + joints + "}}]\n");
}

/** The ten humanoids that are imported, stand and walk: seed of random_biped(). */
constexpr int kNumHumanoids = 10;
constexpr unsigned kHumanoidsSeed = 10;

/** A humanoid of random dimensions: leg length 0.2 to 0.9 m, 3 to 50 kg, either order of the hip's
 * axes, with a waist or without, with a leg that has a closed form or not. */
inline TestBiped random_biped(std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto toss = [&] { return uniform(0, 1) < 0.5; };
  TestBiped biped;
  const double length = uniform(0.2, 0.9);
  biped.thigh = uniform(0.4, 0.5) * length;
  biped.shank = uniform(0.4, 0.45) * length;
  biped.foot_height = 0.1 * length;
  biped.hip_width = uniform(0.25, 0.4) * length;
  biped.mass = uniform(3, 50);
  biped.hip = toss() ? "yxz" : "zxy";
  biped.has_waist = toss();
  if (toss()) {
    biped.hip_offset = uniform(0.02, 0.1) * length;
    biped.knee_offset = uniform(-0.04, 0.04) * length;
    biped.ankle_offset = uniform(0, 0.03) * length;
  }
  return biped;
}

}  // namespace nao
