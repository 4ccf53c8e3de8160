#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/actions/kick_impact.h"

namespace nao::motion {

/** File of a kick, in the robot's folder. */
constexpr const char* kKickFile = "actions/kick.yaml";

/** A kick as data/robots/NAME/actions/kick.yaml describes it; the members carry the file's keys,
 * and the file says what each means. */
struct Kick {
  struct Phase {
    std::string name;
    double duration = 0;
    Eigen::Vector2d com = Eigen::Vector2d::Zero();
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();
    double pitch = 0;
  };

  Eigen::Vector2d ball = Eigen::Vector2d::Zero();
  Eigen::Vector2d ball_reach = Eigen::Vector2d::Zero();
  Eigen::Vector2d foot_reach = Eigen::Vector2d::Zero();
  double ball_contact = 0;
  /** At strength 0 and 1. */
  std::array<double, 2> strike_duration{};
  double strength = 0;
  double balance_gain = 0;
  Eigen::Vector2d zmp_reach = Eigen::Vector2d::Zero();
  std::vector<Phase> phases;
  std::optional<KickImpact> impact;

  /** @throws ModelError  naming the line and what is wrong with it. */
  static Kick load(const std::filesystem::path& file);
};

}  // namespace nao::motion
