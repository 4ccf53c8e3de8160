#include "robot_model/robot_model.h"

#include <algorithm>

#include "common/data_path.h"
#include "common/error.h"
#include "robot_model/robot_model_reader.h"

namespace nao {
namespace {

/** @return nullptr if no item fulfils the condition. */
template <class Item, class Condition>
const Item* find_item(const std::vector<Item>& items, Condition condition) {
  const auto found = std::find_if(items.begin(), items.end(), condition);
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

const JointPair* Symmetry::find_pair(const std::string& name) const {
  return find_item(pairs, [&](const JointPair& pair) { return pair.name == name; });
}

RobotModel RobotModel::load(const std::filesystem::path& folder) {
  return RobotModelReader::read(folder);
}

RobotModel RobotModel::find(const std::string& name) {
  return load(data_path() / "robots" / name);
}

const Posture* RobotModel::find_posture(const std::string& name) const {
  return find_item(postures_, [&](const Posture& posture) { return posture.name == name; });
}

const Posture& RobotModel::ready_posture() const {
  const Posture* posture = find_posture(references_.ready);
  if (posture == nullptr) throw ModelError(name_ + " has no ready posture");
  return *posture;
}

const Action* RobotModel::find_action(const std::string& name) const {
  return find_item(actions_, [&](const Action& action) { return action.name == name; });
}

const Action* RobotModel::find_action(Action::Kind kind, Side side) const {
  return find_item(
      actions_, [&](const Action& action) { return action.kind == kind && action.side == side; });
}

}  // namespace nao
