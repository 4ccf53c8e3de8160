#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/gateway_robot.h"
#include "phone-gateway/server/exhibition/exhibition_settings.h"
#include "phone-gateway/server/exhibition/fence.h"
#include "phone-gateway/server/exhibition/robot_place.h"

namespace nao::gateway {

/** What visitors of an exhibition may command, where the robot is, and how fast it may walk there.
 */
class VisitorRules {
 public:
  /** `robot` and `choices` must outlive this. */
  VisitorRules(const ExhibitionSettings& settings, const OperatorChoices& choices,
               const GatewayRobot& robot)
      : settings_(settings), choices_(choices), robot_(robot), fence_(settings.fence) {}

  /** @return Why no visitor may send this, or nothing. */
  [[nodiscard]] std::optional<Refusal> check(const naoremote::Request& request) const;
  /** The part of a velocity that fence and speed allow. */
  WalkCommand limit(const WalkCommand& velocity) const;
  /** Takes the robot's newest state. */
  void step();
  /** Where robot and ball are, m, in the fence's frame; empty: not known. */
  std::optional<Eigen::Vector2d> robot() const;
  std::optional<Eigen::Vector2d> ball() const;

 private:
  bool is_forbidden(const std::string& action) const;
  bool is_inside(const naoremote::MoveTo& move) const;
  bool is_place_known() const;

  const ExhibitionSettings settings_;
  const OperatorChoices& choices_;
  const GatewayRobot& robot_;
  Fence fence_;
  RobotPlace place_;
  /** Robot time of the last pose on the field, microseconds. */
  uint64_t vision_utime_ = 0;
};

}  // namespace nao::gateway
