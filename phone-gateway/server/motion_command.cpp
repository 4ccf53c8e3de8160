#include "phone-gateway/server/motion_command.h"

namespace nao {
namespace {

struct Describer {
  std::string operator()(const WalkVelocity&) const { return "walk"; }
  std::string operator()(const RelativeGoal&) const { return "walk to a place"; }
  std::string operator()(const PostureGoal& goal) const { return "posture " + goal.posture; }
  std::string operator()(const JointChange& change) const {
    std::string text = "turn";
    for (const std::string& name : change.joint_names) text += " " + name;
    return text;
  }
  std::string operator()(const NamedAction& action) const { return "action " + action.action; }
  std::string operator()(const StopMotion&) const { return "stop"; }
};

}  // namespace

std::string describe(const MotionCommand& command) {
  return std::visit(Describer{}, command);
}

}  // namespace nao
