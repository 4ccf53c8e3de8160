#pragma once

#include <filesystem>
#include <string>

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

  /** Links and joints. */
  void read_urdf(const std::filesystem::path& file);

  // Entries of robot.yaml.
  void read_motors(const YamlEntry& types, const YamlEntry& motors);
  void read_coupled_limits(const YamlEntry& list);
  void read_joint_groups(const YamlEntry& list);
  void read_cameras(const YamlEntry& list);
  void read_inertial_unit(const YamlEntry& entry);
  void read_foot_sensors(const YamlEntry& list);
  void read_soles(const YamlEntry& entry);
  void read_contact_clusters(const YamlEntry& list);
  void read_walk_limits(const YamlEntry& entry);
  void read_actions(const YamlEntry& list);

  // Entries of postures.yaml.
  void read_postures(const YamlEntry& list);

  /** Assigns the foot sensors to the feet that carry them. After read_soles(). */
  void assign_foot_sensors(const YamlEntry& list);

  int motor_named(const YamlEntry& entry) const;
  int link_named(const YamlEntry& entry) const;

  RobotModel model_;
};

}  // namespace nao
