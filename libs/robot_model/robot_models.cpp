#include "robot_model/robot_models.h"

#include "common/error.h"

namespace nao {
namespace {

/** Names come in messages: no path leads out of robots/. */
bool is_folder_name(const std::string& name) {
  return name.find('/') == std::string::npos && !name.starts_with('.');
}

}  // namespace

RobotModels::RobotModels(const RobotModel& own)
    : own_(own), own_name_(own.folder().filename().string()) {}

std::shared_ptr<const RobotModel> RobotModels::find(const std::string& name) {
  if (name.empty() || name == own_name_) return nullptr;
  const auto [entry, is_new] = models_.try_emplace(name);
  Entry& found = entry->second;
  if (is_new) {
    // A model that cannot be read is not tried again with every message.
    try {
      if (!is_folder_name(name))
        throw ModelError("\"" + name + "\" is not a valid name of a robot's folder");
      found.model = std::make_shared<const RobotModel>(RobotModel::find(name));
    } catch (const Error& error) {
      found.fault = error.what();
    }
  }
  if (!found.model) throw ModelError(found.fault);
  return found.model;
}

}  // namespace nao
