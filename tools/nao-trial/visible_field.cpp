#include "tools/nao-trial/visible_field.h"

#include <cmath>

#include "kinematics/pose2.h"

namespace nao::trial {
namespace {

/** Distance between the points of a line that are projected, m; least number of them. */
constexpr double kStep = 0.05;
constexpr size_t kLeastPoints = 4;

}  // namespace

bool VisibleField::is_in_image(const cv::Point2f& pixel) const {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < static_cast<float>(width_) &&
         pixel.y < static_cast<float>(height_);
}

std::vector<std::vector<cv::Point2f>> VisibleField::pieces(const vision::FieldLine& line) const {
  std::vector<std::vector<cv::Point2f>> result;
  std::vector<cv::Point2f> piece;
  const auto finish = [&] {
    if (piece.size() >= kLeastPoints) result.push_back(piece);
    piece.clear();
  };
  const int num_steps = static_cast<int>(std::ceil((line.to - line.from).norm() / kStep));
  for (int i = 0; i <= num_steps; ++i) {
    const Eigen::Vector2d point = line.from + (line.to - line.from) * i / num_steps;
    const auto pixel = truth_.project({point.x(), point.y(), 0});
    if (pixel && is_in_image(*pixel)) {
      piece.push_back(*pixel);
    } else {
      finish();
    }
  }
  finish();
  return result;
}

std::vector<cv::Point2f> VisibleField::circle() const {
  std::vector<cv::Point2f> visible;
  for (size_t i = 0; i < kNumCirclePoints; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / kNumCirclePoints;
    const double radius = field_.circle_radius();
    const auto pixel = truth_.project({radius * std::cos(angle), radius * std::sin(angle), 0});
    if (pixel && is_in_image(*pixel)) visible.push_back(*pixel);
  }
  return visible;
}

std::optional<Eigen::Vector2d> find_seen_center(const std::vector<cv::Point2f>& circle,
                                                const vision::CameraCalibration& calibration,
                                                const Eigen::Isometry3d& true_pose,
                                                const Eigen::Isometry3d& estimated_pose) {
  const cv::Point2f middle = circle[circle.size() / 2];
  const auto seen = vision::CameraGeometry(calibration, estimated_pose).at_height(middle, 0);
  const auto arc = vision::CameraGeometry(calibration, true_pose).at_height(middle, 0);
  if (!seen || !arc) return std::nullopt;
  const Eigen::Rotation2Dd turn(heading_of(estimated_pose.linear()) -
                                heading_of(true_pose.linear()));
  return *seen + turn * Eigen::Vector2d(-*arc);
}

}  // namespace nao::trial
