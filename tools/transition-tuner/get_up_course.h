#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "daemons/motion/transitions/transition_graph.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"

namespace nao {

/** How a graph of transitions did from one start. */
struct GetUpResult {
  bool is_up = false;
  /** s from lying still to standing in StandInit. */
  double time = 0;
  /** s if it stood at the first try; else more than any time, the less the higher it came. */
  double cost = 0;
};

/** What a way up from the floor is judged by: getting up at the first try, and how long that takes,
 * from lying on a side of the body, each time with a physics, noise and latency of its own. */
class GetUpCourse {
 public:
  enum class Start { kAny, kBelly, kBack, kLeft, kRight };

  GetUpCourse(std::shared_ptr<const RobotModel> model, SceneFile scene, Start start)
      : model_(std::move(model)), scene_(std::move(scene)), start_(start) {}

  /** @param seed  Of everything drawn by chance: of even ones the robot is laid down, of odd ones
   * pushed over. */
  GetUpResult run(const motion::TransitionGraph& transitions, uint64_t seed) const;

 private:
  std::shared_ptr<const RobotModel> model_;
  SceneFile scene_;
  Start start_;
};

/** @throws ConfigError  if there is no such start. */
GetUpCourse::Start parse_start(const std::string& name);

}  // namespace nao
