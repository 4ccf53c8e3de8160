#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace nao::vision {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/** Kind of a detection, in the order of detection_t's KIND_*. */
enum class Kind {
  kBall,
  kLine,
  kCrossingL,
  kCrossingT,
  kCrossingX,
  kCenterCircle,
  kGoalPost,
  kRobot,
  kPenaltyMark
};
inline constexpr int kNumKinds = 9;

/** "ball", "line", "crossing-l", ... */
const char* kind_name(Kind kind);

/** One object in an image. The heading frame H has its origin on the ground below the torso, x
 * along the torso's heading, y left. */
struct Detection {
  Kind kind = Kind::kBall;
  /** Left, top, right, bottom in the distorted image, pixels. */
  Eigen::Vector4d box_px = Eigen::Vector4d::Zero();
  /** Lines: x1, y1, x2, y2 in the distorted image, pixels; NaN otherwise. */
  Eigen::Vector4d line_px = Eigen::Vector4d::Constant(kUnknown);
  /** On the ground in H, m; of a line its first end, of a circle its center. NaN if unknown. */
  Eigen::Vector2d position = Eigen::Vector2d::Constant(kUnknown);
  /** Lines: second end on the ground in H, m; NaN otherwise. */
  Eigen::Vector2d end = Eigen::Vector2d::Constant(kUnknown);
  /** Covariance of `position`, m^2; NaN if unknown. */
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Constant(kUnknown);
  /** 0 to 1. */
  double confidence = 0;

  bool has_position() const { return position.allFinite(); }
};

using Detections = std::vector<Detection>;

}  // namespace nao::vision
