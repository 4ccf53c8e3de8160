#include <algorithm>
#include <cmath>

#include "daemons/vision/landmarks.h"

namespace nao::vision {
namespace {

/** Distance between the columns that are searched, pixels. */
constexpr int kSpacing = 4;
/** Obstacles reach this high above the ground at least where they stand, m: higher than a ball. */
constexpr double kLeastHeight = 0.16;
/** Farthest foot of an obstacle, m. */
constexpr double kReach = 6;

/** Rows of FieldView::other between the field's border and a foot on the field. */
constexpr int kLeastRowsInside = 5;

/** A goal post: width and height, m. */
constexpr double kPostWidth = 0.1;
constexpr double kPostHeight = 0.85;
/** A robot: widths, m; two robots side by side are taken as one. */
constexpr double kLeastRobotWidth = 0.1;
constexpr double kMostRobotWidth = 0.9;

/** Lowest point of what is not field in a column. */
struct Foot {
  float x;
  float y;
  /** Ground, m. */
  Eigen::Vector2d position;
};

uint8_t other_at(const FieldView& view, float x, float y) {
  const int column = std::clamp(static_cast<int>(x / 2), 0, view.other.cols - 1);
  const int row = std::clamp(static_cast<int>(y / 2), 0, view.other.rows - 1);
  return view.other(row, column);
}

/** Fraction of the vertical line from the ground to `height` that is not field, where in view. */
double coverage(const FieldView& view, const CameraGeometry& geometry,
                const Eigen::Vector2d& position, double height) {
  constexpr int kNumSteps = 10;
  int num_seen = 0;
  int num_other = 0;
  for (int i = 1; i <= kNumSteps; ++i) {
    // Projection of a vertical pole that stands there, by its height over the ground.
    const auto pixel = geometry.project({position.x(), position.y(), height * i / kNumSteps});
    if (!pixel || pixel->y < 0 || pixel->x < 0 ||
        pixel->x >= static_cast<float>(view.smooth.cols)) {
      break;
    }
    ++num_seen;
    num_other += other_at(view, pixel->x, pixel->y) > 160;
  }
  return num_seen == 0 ? 0 : static_cast<double>(num_other) / num_seen;
}

/** Feet of obstacles in one column, from below: a run of other colors that is as high as an
 * obstacle at that place. */
// Searched from below: the first place where something begins above the field.
std::optional<Foot> find_foot(const FieldView& view, const CameraGeometry& geometry, float x) {
  const int top = view.top[std::min(static_cast<int>(x / 2), view.other.cols - 1)];
  bool is_field_below = false;
  for (int row = view.other.rows - 1; row > std::max(top, 1); row -= 2) {
    const float y = 2 * static_cast<float>(row);
    // What begins at the border stands behind the field.
    if (row - top < kLeastRowsInside) break;
    if (view.other(row, static_cast<int>(x / 2)) <= 160) {
      is_field_below = true;
      continue;
    }
    if (!is_field_below) continue;
    is_field_below = false;
    const auto ground = geometry.at_height(geometry.undistorted({x, y}), 0);
    // Nearer than 0.15 m are the robot's own feet.
    if (!ground || ground->norm() > kReach || ground->norm() < 0.15) continue;
    if (coverage(view, geometry, *ground, kLeastHeight) < 0.8) continue;
    return Foot{x, y, *ground};
  }
  return std::nullopt;
}

std::vector<std::vector<Foot>> find_clusters(const FieldView& view,
                                             const CameraGeometry& geometry) {
  std::vector<std::vector<Foot>> clusters;
  for (int x = 0; x < view.smooth.cols; x += kSpacing) {
    const auto foot = find_foot(view, geometry, static_cast<float>(x));
    if (!foot) continue;
    // The uncertainty of the distance grows with the distance, hence the second part of the limit.
    // Legs stand apart: what is within 15 cm on the ground or along the view belongs together.
    std::vector<Foot>* home = nullptr;
    for (std::vector<Foot>& cluster : clusters) {
      const Foot& last = cluster.back();
      const double range = last.position.norm();
      const double limit = 0.15 + 0.08 * range;
      if ((last.position - foot->position).norm() < limit) home = &cluster;
    }
    if (home == nullptr) home = &clusters.emplace_back();
    home->push_back(*foot);
  }
  return clusters;
}

/** A vertical line from the ground upwards is white, and differs from what is beside it. */
bool is_bar(const FieldView& view, const CameraGeometry& geometry, const Eigen::Vector2d& position,
            double height) {
  int num_white = 0;
  int num_edges = 0;
  int num_seen = 0;
  // Points beside the pole at its distance, m, across the line of sight.
  const Eigen::Vector2d side = 0.11 * Eigen::Vector2d(-position.y(), position.x()).normalized();
  for (int i = 1; i <= 8; ++i) {
    const auto pixel = geometry.project({position.x(), position.y(), height * i / 8});
    if (!pixel || pixel->y < 0 || pixel->x < 0 ||
        pixel->x >= static_cast<float>(view.smooth.cols) ||
        pixel->y >= static_cast<float>(view.smooth.rows)) {
      continue;
    }
    ++num_seen;
    const cv::Vec3b& color = view.smooth(static_cast<int>(pixel->y), static_cast<int>(pixel->x));
    const int low = std::min({color[0], color[1], color[2]});
    const int high = std::max({color[0], color[1], color[2]});
    num_white += low > 70 && low > 0.6 * high;
    bool is_edge = true;
    for (const double sign : {-1.0, 1.0}) {
      const auto beside = geometry.project(
          {position.x() + sign * side.x(), position.y() + sign * side.y(), height * i / 8});
      if (!beside || beside->y < 0 || beside->x < 0 ||
          beside->x >= static_cast<float>(view.smooth.cols) ||
          beside->y >= static_cast<float>(view.smooth.rows)) {
        continue;
      }
      const cv::Vec3b& other =
          view.smooth(static_cast<int>(beside->y), static_cast<int>(beside->x));
      is_edge &= cv::norm(cv::Vec3d(color) - cv::Vec3d(other)) > 25;
    }
    num_edges += is_edge;
  }
  return num_seen >= 5 && num_white >= 0.85 * num_seen && num_edges >= 0.75 * num_seen;
}

Detection make_detection(Kind kind, const FieldView& view, const CameraGeometry& geometry,
                         const std::vector<Foot>& cluster, double height) {
  const Foot& left = cluster.front();
  const Foot& right = cluster.back();
  // The lowest pixel is the nearest foot.
  const Foot& nearest = *std::max_element(cluster.begin(), cluster.end(),
                                          [](const Foot& a, const Foot& b) { return a.y < b.y; });
  Detection detection;
  detection.kind = kind;
  const cv::Point2f foot(0.5f * (left.x + right.x), nearest.y);
  if (const auto ground = geometry.locate(geometry.undistorted(foot))) {
    detection.position = ground->position;
    detection.covariance = ground->covariance;
  }
  double top = nearest.y;
  if (const auto head = geometry.project({nearest.position.x(), nearest.position.y(), height})) {
    top = std::max(0.0f, head->y);
  }
  // Half of the spacing on each side: an obstacle ends somewhere between two searched columns.
  detection.box_px = {left.x - 0.5 * kSpacing, top, right.x + 0.5 * kSpacing,
                      std::min<double>(nearest.y + 2, view.smooth.rows - 1)};
  return detection;
}

double ground_width(const std::vector<Foot>& cluster, const CameraGeometry& geometry) {
  // At the distance of the nearest foot, since feet are seen at different distances.
  const Foot& nearest = *std::max_element(cluster.begin(), cluster.end(),
                                          [](const Foot& a, const Foot& b) { return a.y < b.y; });
  const auto a =
      geometry.at_height(geometry.undistorted({cluster.front().x - 0.5f * kSpacing, nearest.y}), 0);
  const auto b =
      geometry.at_height(geometry.undistorted({cluster.back().x + 0.5f * kSpacing, nearest.y}), 0);
  return a && b ? (*a - *b).norm() : 0;
}

bool overlap(const Detection& a, const Detection& b) {
  return std::min(a.box_px[2], b.box_px[2]) > std::max(a.box_px[0], b.box_px[0]) &&
         std::min(a.box_px[3], b.box_px[3]) > std::max(a.box_px[1], b.box_px[1]);
}

}  // namespace

Detections GoalPostDetector::detect(const FieldView& view, const CameraGeometry& geometry) const {
  Detections posts;
  if (!geometry.has_pose()) return posts;
  for (const std::vector<Foot>& cluster : find_clusters(view, geometry)) {
    const double width = ground_width(cluster, geometry);
    // Bounds as factors of the width: columns are 4 pixels apart, and feet are found roughly.
    if (width < 0.5 * kPostWidth || width > 2.2 * kPostWidth) continue;
    const Foot& middle = cluster[cluster.size() / 2];
    if (coverage(view, geometry, middle.position, kPostHeight) < 0.95 ||
        !is_bar(view, geometry, middle.position, kPostHeight)) {
      continue;
    }
    Detection post = make_detection(Kind::kGoalPost, view, geometry, cluster, kPostHeight);
    post.confidence = 0.7;
    posts.push_back(post);
  }
  return posts;
}

Detections RobotDetector::detect(const FieldView& view, const CameraGeometry& geometry,
                                 const Detections& posts,
                                 const std::optional<Detection>& ball) const {
  Detections robots;
  if (!geometry.has_pose()) return robots;
  for (const std::vector<Foot>& cluster : find_clusters(view, geometry)) {
    const double width = ground_width(cluster, geometry);
    if (width < kLeastRobotWidth || width > kMostRobotWidth) continue;
    const Foot& middle = cluster[cluster.size() / 2];
    if (coverage(view, geometry, middle.position, 0.35) < 0.6) continue;
    Detection robot = make_detection(Kind::kRobot, view, geometry, cluster, 0.55);
    const bool is_post = std::any_of(posts.begin(), posts.end(),
                                     [&](const Detection& post) { return overlap(post, robot); });
    // A ball looks like a narrow obstacle; what overlaps a post is that post.
    if (is_post || (ball && overlap(*ball, robot) && width < 0.2)) continue;
    robot.confidence = std::min(0.9, 0.4 + width);
    robots.push_back(robot);
  }
  return robots;
}

}  // namespace nao::vision
