#include "phone-gateway/server/exhibition/challenge.h"

#include <utility>

#include "phone-gateway/server/exhibition/fence.h"

namespace nao::gateway {
namespace {

/** Longest way between two steps, m: what moves farther was carried. Chosen: a ball at 4 m/s in the
 * 0.1 s between two images. */
constexpr double kMaxWay = 0.4;

}  // namespace

bool Challenge::step(const std::optional<Eigen::Vector2d>& place) {
  const std::optional<Eigen::Vector2d> before = std::exchange(last_place_, place);
  if (!before || !place || settings_.posts.empty()) return false;
  if ((*place - *before).norm() > kMaxWay) return false;
  const Eigen::Vector2d& left = settings_.posts[0];
  const Eigen::Vector2d& right = settings_.posts[1];
  if (!do_cross(*before, *place, left, right)) return false;
  return !settings_.is_goal ||
         side_of_line(left, right, *before) * side_of_line(left, right, Eigen::Vector2d::Zero()) >
             0;
}

}  // namespace nao::gateway
