#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/yaml_entry.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Fills a RobotModel from its files. Every function throws ModelError with the file, the element
 * and what is wrong with it. */
class RobotModelReader {
 public:
  static RobotModel read(const std::filesystem::path& folder);

 private:
  explicit RobotModelReader(const std::filesystem::path& folder);

  /** Links and joints, in the order of order_joints(). @param limb_of_link  As there. */
  void read_urdf(const std::filesystem::path& file, const std::map<std::string, int>& limb_of_link);

  // Entries of robot.yaml: mechanism and sensors (robot_model_reader.cpp).
  void read_motors(const YamlEntry& types, const YamlEntry& motors);
  void read_coupled_limits(const YamlEntry& list);
  void read_cameras(const YamlEntry& list);
  void read_inertial_unit(const YamlEntry& entry);
  /** Motors of a robot whose robot.yaml does not list them, from the URDF's limits. */
  void estimate_motors(const YamlEntry& robot);
  /** Without clusters, only bodies that a joint connects, and the pairs of `allowed_contacts`, may
   * touch. */
  void read_contact_clusters(const YamlEntry& robot);

  // Limbs and symmetry (robot_limbs_reader.cpp).
  void read_limbs(const YamlEntry& robot);
  void read_sole(const YamlEntry& entry, LegDescription& leg);
  void read_foot_sensors(const YamlEntry& list);
  void read_symmetry(const YamlEntry& robot);
  void read_joint_groups(const YamlEntry& list);

  // Motions of the robot (robot_motions_reader.cpp).
  void read_postures(const YamlEntry& list);
  void read_references(const YamlEntry& robot);
  void read_actions(const YamlEntry& list);
  /** Adds the robot's policies to its actions. */
  void find_policies();
  void read_labels(const YamlEntry& root);
  void read_heights(const YamlEntry& entry);
  void read_contact_forces(const YamlEntry& robot);
  void read_walking_stance(const YamlEntry& entry);
  void read_walking_arms(const YamlEntry& entry);
  /** Angles of joints or joint pairs; NaN for joints that are not named. */
  std::vector<double> read_pose(const YamlEntry& joints) const;

  /** Adds a name. @throws ModelError  if it is known already. */
  static void add_unique(std::set<std::string>& names, const YamlEntry& entry);
  int motor_named(const YamlEntry& entry) const;
  int link_named(const YamlEntry& entry) const;

  RobotModel model_;
};

}  // namespace nao
