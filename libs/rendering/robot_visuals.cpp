#include "rendering/robot_visuals.h"

namespace nao {

RobotVisuals::RobotVisuals(const RobotModel& own, SceneRenderer& renderer)
    : renderer_(renderer),
      own_(std::make_unique<RobotVisual>(own, renderer)),
      problems_(own_->problems()) {}

const RobotVisual& RobotVisuals::of(const RobotPose& robot) {
  if (!robot.model) return *own_;
  Entry& entry = others_[robot.model.get()];
  if (!entry.visual) {
    entry.model = robot.model;
    entry.visual = std::make_unique<RobotVisual>(*robot.model, renderer_);
    const auto& problems = entry.visual->problems();
    problems_.insert(problems_.end(), problems.begin(), problems.end());
  }
  return *entry.visual;
}

std::vector<Eigen::Isometry3d> RobotVisuals::append(Scene& scene, const RobotPose& robot,
                                                    const Color& tint, int hidden_link) {
  const RobotVisual& visual = of(robot);
  auto poses = link_poses_in_world(visual.model(), robot.pose_torso_in_world, robot.position);
  visual.append(scene, poses, tint, hidden_link);
  visual.append_lights(scene, poses, robot.lights, hidden_link);
  if (robot.number > 0) visual.append_shirt(scene, poses, robot.team, robot.number, hidden_link);
  return poses;
}

}  // namespace nao
