#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "daemons/motion/transitions/transition_graph.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"

namespace nao {

/** Result of a transition graph from one start. */
struct GetUpResult {
  bool is_up = false;
  /** s from lying still to standing in StandInit. */
  double time = 0;
  /** Time in s if it stood at the first try; otherwise a penalty above any time, decreasing with
   * the height reached. */
  double cost = 0;
};

/** Cost function of get-up motions: success at the first try and its duration, from lying on one
 * side of the body. Physics, noise and latency are random in each trial. */
class GetUpCourse {
 public:
  enum class Start { kAny, kBelly, kBack, kLeft, kRight };

  GetUpCourse(std::shared_ptr<const RobotModel> model, SceneFile scene, Start start)
      : model_(std::move(model)), scene_(std::move(scene)), start_(start) {}

  /** @param seed  Seed of all random values. Even: the robot is placed lying; odd: it is pushed
   * over. */
  GetUpResult run(const motion::TransitionGraph& transitions, uint64_t seed) const;

 private:
  std::shared_ptr<const RobotModel> model_;
  SceneFile scene_;
  Start start_;
};

/** @throws ConfigError  if there is no such start. */
GetUpCourse::Start parse_start(const std::string& name);

}  // namespace nao
