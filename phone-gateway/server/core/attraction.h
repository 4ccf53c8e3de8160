#pragma once

#include <cstddef>

#include "phone-gateway/server/core/gateway_robot.h"
#include "phone-gateway/server/exhibition/exhibition_settings.h"

namespace nao::gateway {

/** What the robot of an exhibition does while no visitor is there: greets, plays actions and taught
 * motions, looks at the ball, one after the other. */
class Attraction {
 public:
  /** `robot` must outlive this. */
  Attraction(const ExhibitionSettings& settings, GatewayRobot& robot)
      : settings_(settings), robot_(robot) {}

  /** @param may_begin  Nobody is there, and the robot may move; false: what runs ends at once.
   * @param volume  0 to 1. */
  void step(bool may_begin, double volume, double now);

 private:
  void begin_next(double volume, double now);
  void look_at_ball(double now);
  void end(double now);

  const ExhibitionSettings settings_;
  GatewayRobot& robot_;
  bool is_active_ = false;
  size_t num_begun_ = 0;
  double next_ = 0;
};

}  // namespace nao::gateway
