#pragma once

#include <map>
#include <memory>
#include <string>

#include "robot_model/robot_model.h"

namespace nao {

/** Models of the robots in a world of several, by the name of their folder in robots/. Each is
 * loaded once, when it is first needed. */
class RobotModels {
 public:
  /** @param own  Model of the program's own robot, which is not loaded again; must outlive this. */
  explicit RobotModels(const RobotModel& own);

  const RobotModel& own() const { return own_; }
  /** @param name  As in robot_truth_t; empty for the own model.
   * @return Nothing for the own model. @throws ModelError  if its files cannot be read. */
  std::shared_ptr<const RobotModel> find(const std::string& name);

 private:
  struct Entry {
    std::shared_ptr<const RobotModel> model;
    /** Why it could not be loaded. */
    std::string fault;
  };

  const RobotModel& own_;
  std::string own_name_;
  std::map<std::string, Entry> models_;
};

}  // namespace nao
