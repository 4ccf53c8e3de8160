#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/pose2.h"
#include "messages/match_command.h"
#include "messages/match_state.h"

namespace nao::referee {

/** A robot as the referee sees it. */
struct RobotSighting {
  std::string name;
  /** m, in the field frame: x along team 0's attack, y left. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  bool is_upright = true;
  bool touches_ball = false;
  bool is_autonomous = false;
  PlayRole role = PlayRole::kNone;
};

struct RefereeInput {
  /** Robot time, s. */
  double time = 0;
  /** Ball center, m, in the field frame. */
  Eigen::Vector3d ball = Eigen::Vector3d::Zero();
  std::vector<RobotSighting> robots{};
};

/** An action of the referee: puts the ball, or a robot on its feet, at a place. */
struct Placement {
  /** Empty: the ball. */
  std::string robot{};
  /** In the field frame. */
  Pose2 pose;
};

struct RefereeOutput {
  std::vector<Placement> placements;
  std::vector<MatchEvent> events;
};

/** Decides in a match, without clock and bus. */
class Referee {
 public:
  Referee() = default;
  virtual ~Referee() = default;
  Referee(const Referee&) = delete;
  Referee& operator=(const Referee&) = delete;

  /** Continues a match that another referee began, with its own players. */
  virtual void restore(const MatchState& state) = 0;
  virtual RefereeOutput step(const RefereeInput& input) = 0;
  /** Overrules the referee's own decision. @return Nothing, or why it cannot. */
  [[nodiscard]] virtual std::optional<Reason> overrule(const MatchCommand& command) = 0;
  virtual const MatchState& state() const = 0;
};

}  // namespace nao::referee
