#include <algorithm>
#include <bitset>
#include <cmath>

#include "common/random.h"
#include "daemons/vision/landmarks.h"

namespace nao::vision {
namespace {

/** Pairs of points that are tried. If a fifth of the points lie on the circle, both of one pair do
 * with the probability 1 - (1 - 0.2^2)^150 = 0.998. */
constexpr int kNumCircleSamples = 150;
/** Least number of points, and of sectors of 10 degrees that have one. Tuned on rendered images:
 * rectangles of lines reach 9 sectors. */
constexpr size_t kLeastPoints = 16;
constexpr size_t kLeastSectors = 12;
/** Least number of such sectors in succession, and greatest root mean square of the residuals, as a
 * fraction of the tolerance: rectangles touch a circle in separate places. */
constexpr int kLeastRun = 9;
constexpr int kNumSectors = 36;

double tolerance_at(const Eigen::Vector2d& point,
                    const VisionParameters::CenterCircle& parameters) {
  return parameters.tolerance + parameters.tolerance_of_distance * point.norm();
}

/** Longest succession of sectors, around the circle. */
int longest_run(const std::bitset<kNumSectors>& sectors) {
  int longest = 0;
  int run = 0;
  // Goes around twice, so that a run across the angle 0 counts as one.
  for (int i = 0; i < 2 * kNumSectors; ++i) {
    run = sectors[i % kNumSectors] ? run + 1 : 0;
    longest = std::max(longest, std::min(run, kNumSectors));
  }
  return longest;
}

}  // namespace

std::optional<Detection> CenterCircleDetector::detect(std::vector<LinePoint>& points,
                                                      std::vector<cv::Point2f>& ideal,
                                                      const CameraGeometry& geometry) const {
  if (!geometry.has_pose()) return std::nullopt;
  const auto tolerance = [&](const Eigen::Vector2d& point) {
    return tolerance_at(point, parameters_);
  };
  std::vector<Eigen::Vector2d> ground;
  std::vector<size_t> index;
  for (size_t i = 0; i < ideal.size(); ++i) {
    const auto point = geometry.at_height(ideal[i], 0);
    if (!point || point->norm() > parameters_.reach) continue;
    ground.push_back(*point);
    index.push_back(i);
  }
  if (ground.size() < kLeastPoints) return std::nullopt;

  // RANSAC with a fixed seed, so that an image always gives the same result. Two points and the
  // known radius determine two circles.
  Random random(2);
  std::vector<double> tolerances;
  for (const Eigen::Vector2d& point : ground) tolerances.push_back(tolerance(point));
  size_t best_sectors = 0;
  std::vector<size_t> best;
  Eigen::Vector2d best_center = Eigen::Vector2d::Zero();
  for (int sample = 0; sample < kNumCircleSamples; ++sample) {
    const Eigen::Vector2d& a = ground[random.next() % ground.size()];
    const Eigen::Vector2d& b = ground[random.next() % ground.size()];
    const Eigen::Vector2d chord = b - a;
    const double half = 0.5 * chord.norm();
    // A short chord determines the center badly; one longer than the diameter none.
    if (half < 0.2 * radius_ || half >= radius_) continue;
    const Eigen::Vector2d normal = Eigen::Vector2d(-chord.y(), chord.x()).normalized();
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector2d center =
          0.5 * (a + b) + side * std::sqrt(radius_ * radius_ - half * half) * normal;
      std::bitset<kNumSectors> sectors;
      std::vector<size_t> on_circle;
      // The tolerance grows with distance, as the projection's error does.
      for (size_t i = 0; i < ground.size(); ++i) {
        if (std::abs((ground[i] - center).norm() - radius_) <= tolerances[i])
          on_circle.push_back(i);
      }
      // Most circles have too few points to be the best, in however many directions.
      const size_t most_sectors = std::min<size_t>(on_circle.size(), kNumSectors);
      if (most_sectors * on_circle.size() <= best_sectors * best.size()) continue;
      for (const size_t i : on_circle) {
        const Eigen::Vector2d d = ground[i] - center;
        const double turn = std::atan2(d.y(), d.x()) / (2 * M_PI) + 0.5;
        sectors.set(std::min(kNumSectors - 1, static_cast<int>(turn * kNumSectors)));
      }
      // Many points in many directions: a line has many points in few directions only.
      if (sectors.count() * on_circle.size() <= best_sectors * best.size()) continue;
      best_sectors = sectors.count();
      best = std::move(on_circle);
      best_center = center;
    }
  }
  if (best.size() < kLeastPoints || best_sectors < kLeastSectors) return std::nullopt;

  // Gauss-Newton on the distances from the circle.
  // Residuals r_i = |p_i - c| - R with dr_i/dc = -(p_i - c) / |p_i - c|, weighted with 1 /
  // tolerance^2; the small identity keeps the matrix regular.
  for (int step = 0; step < 3; ++step) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Identity() * 1e-6;
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const size_t i : best) {
      const Eigen::Vector2d d = ground[i] - best_center;
      const double weight = 1 / (tolerance(ground[i]) * tolerance(ground[i]));
      const Eigen::Vector2d direction = d.normalized();
      normal += weight * direction * direction.transpose();
      right += weight * (d.norm() - radius_) * direction;
    }
    best_center += normal.inverse() * right;
  }

  // Checked again for the refined center, more strictly.
  std::bitset<kNumSectors> sectors;
  double residual = 0;
  for (const size_t i : best) {
    const Eigen::Vector2d d = ground[i] - best_center;
    const double turn = std::atan2(d.y(), d.x()) / (2 * M_PI) + 0.5;
    sectors.set(std::min(kNumSectors - 1, static_cast<int>(turn * kNumSectors)));
    residual += std::pow((d.norm() - radius_) / tolerance(ground[i]), 2);
  }
  residual = std::sqrt(residual / static_cast<double>(best.size()));
  if (longest_run(sectors) < kLeastRun || residual > parameters_.most_residual) return std::nullopt;

  Detection detection;
  detection.kind = Kind::kCenterCircle;
  detection.position = best_center;
  detection.confidence = std::min(1.0, static_cast<double>(best_sectors) / 24);
  // Box in the image around the points on the circle.
  Eigen::Vector4d box(1e9, 1e9, -1e9, -1e9);
  for (const size_t i : best) {
    const cv::Point2f& pixel = points[index[i]].pixel;
    box = {std::min<double>(box[0], pixel.x), std::min<double>(box[1], pixel.y),
           std::max<double>(box[2], pixel.x), std::max<double>(box[3], pixel.y)};
  }
  detection.box_px = box;
  // The orientation of the camera moves the circle as it moves the points on it.
  const cv::Point2f middle(static_cast<float>((box[0] + box[2]) / 2),
                           static_cast<float>((box[1] + box[3]) / 2));
  if (const auto located = geometry.locate(geometry.undistorted(middle))) {
    detection.covariance = located->covariance;
  }
  // From the last to the first, so that indices stay valid. The line detector does not see these
  // points any more.
  for (auto i = best.rbegin(); i != best.rend(); ++i) {
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(index[*i]));
    ideal.erase(ideal.begin() + static_cast<std::ptrdiff_t>(index[*i]));
  }
  return detection;
}

}  // namespace nao::vision
