#include "daemons/vision/object_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nao::vision {
namespace {

/** Width and height of a cell; unit of a robot's box; pixels
 * of an image of twice the input's size. */
constexpr int kCell = 16;
constexpr float kBoxUnit = 64;
constexpr int kGridRows = 2 * ObjectDetector::kRows / kCell;
constexpr int kGridColumns = 2 * ObjectDetector::kColumns / kCell;

/** Values of each kind, as in tools/vision-train/train_objects.py: log odds; of balls and posts x,
 * y and logarithm of the radius (cells); of robots the box's distances to the left, top, right and
 * bottom and the foot's x, y (kBoxUnit). All from the middle of the cell. Each value of balls has
 * four planes, for the 2x2 parts of the cells. */
constexpr int kNumBallValues = 4;
constexpr int kNumRobotValues = 7;
constexpr int kNumPostValues = 4;
constexpr int kNumPlanes = 4 * kNumBallValues + kNumRobotValues + kNumPostValues;

/** Least probabilities. Chosen with the images of the tuning places: of balls for a high recall,
 * since each place is judged by another network; of the others for few errors. */
constexpr float kLeastBall = 0.02f;
constexpr float kLeastRobot = 0.45f;
constexpr float kLeastPost = 0.45f;
/** Greatest number of places of balls: each costs 0.04 ms to judge. */
constexpr size_t kMostBalls = 10;
/** Overlap (intersection over union) of two robots' boxes above which they are one robot. */
constexpr double kSameRobot = 0.5;
/** Height of a goal post, m. */
constexpr double kPostHeight = 0.85;

/** The values of one kind for all of its cells. */
class Grid {
 public:
  /** @param first  First plane. @param parts  Parts of a cell in each direction: 1 or 2.
   * @param scale_x, scale_y  Pixels of the image for one of the network's, halved. */
  Grid(const cv::Mat_<float>& output, int first, int parts, float scale_x, float scale_y)
      : output_(output), first_(first), parts_(parts), scale_x_(scale_x), scale_y_(scale_y) {}

  struct Cell {
    int row;
    int column;
    float probability;
  };

  /** Cells that are more probable than their neighbors and than a least one; the best first. */
  std::vector<Cell> peaks(float least) const {
    std::vector<Cell> cells;
    const float least_odds = std::log(least / (1 - least));
    for (int row = 0; row < rows(); ++row) {
      for (int column = 0; column < columns(); ++column) {
        const float odds = at(0, row, column);
        if (odds < least_odds || !is_peak(row, column)) continue;
        cells.push_back({row, column, 1 / (1 + std::exp(-odds))});
      }
    }
    std::sort(cells.begin(), cells.end(),
              [](const Cell& a, const Cell& b) { return a.probability > b.probability; });
    return cells;
  }

  float value(int i, const Cell& cell) const { return at(i, cell.row, cell.column); }

  /** Pixel of the image, from the middle of a cell by values i and i + 1. */
  cv::Point2f point(int i, const Cell& cell, float unit) const {
    return {scale_x_ * (middle(cell.column) + unit * value(i, cell)),
            scale_y_ * (middle(cell.row) + unit * value(i + 1, cell))};
  }

  /** Middle of a cell, pixels of the image. */
  cv::Point2f middle(const Cell& cell) const {
    return {scale_x_ * middle(cell.column), scale_y_ * middle(cell.row)};
  }

  /** Length in pixels of the image. @param i  Index of its logarithm. */
  float radius(int i, const Cell& cell) const {
    return scale_x_ * size() * std::exp(std::clamp(value(i, cell), -3.0f, 3.5f));
  }

  float size() const { return static_cast<float>(kCell) / static_cast<float>(parts_); }

 private:
  int rows() const { return parts_ * kGridRows; }
  int columns() const { return parts_ * kGridColumns; }
  float middle(int index) const { return size() * (static_cast<float>(index) + 0.5f) - 0.5f; }

  float at(int i, int row, int column) const {
    const int part = parts_ * (row % parts_) + column % parts_;
    const int plane = first_ + parts_ * parts_ * i + part;
    return output_(0, (plane * kGridRows + row / parts_) * kGridColumns + column / parts_);
  }

  bool is_peak(int row, int column) const {
    const float odds = at(0, row, column);
    for (int y = std::max(0, row - 1); y <= std::min(rows() - 1, row + 1); ++y) {
      for (int x = std::max(0, column - 1); x <= std::min(columns() - 1, column + 1); ++x) {
        if (at(0, y, x) > odds) return false;
      }
    }
    return true;
  }

  const cv::Mat_<float>& output_;
  int first_;
  int parts_;
  float scale_x_;
  float scale_y_;
};

double overlap(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  const double width = std::min(a[2], b[2]) - std::max(a[0], b[0]);
  const double height = std::min(a[3], b[3]) - std::max(a[1], b[1]);
  if (width <= 0 || height <= 0) return 0;
  const double common = width * height;
  return common / ((a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - common);
}

/** Its place on the ground, where the foot is in the image. */
void locate(const cv::Point2f& foot, int width, int height, const CameraGeometry& geometry,
            Detection& detection) {
  if (foot.x < 0 || foot.y < 0 || foot.x >= static_cast<float>(width) ||
      foot.y >= static_cast<float>(height)) {
    return;
  }
  if (const auto ground = geometry.locate(geometry.undistorted(foot))) {
    detection.position = ground->position;
    detection.covariance = ground->covariance;
  }
}

}  // namespace

NeuralNetwork::Shape ObjectDetector::shape() {
  return {{kColumns, kRows}, kNumPlanes, {kGridColumns, kGridRows}};
}

FoundObjects ObjectDetector::detect(const cv::Mat& half, int width, int height,
                                    const CameraGeometry& geometry) const {
  cv::Mat input = half;
  if (input.rows != kRows || input.cols != kColumns) {
    cv::resize(half, input, {kColumns, kRows}, 0, 0, cv::INTER_AREA);
  }
  const cv::Mat_<float> output = network_->run({input});
  const float scale_x = static_cast<float>(width) / (2 * kColumns);
  const float scale_y = static_cast<float>(height) / (2 * kRows);
  int first = 0;
  const Grid balls(output, first, 2, scale_x, scale_y);
  const Grid robots(output, first += 4 * kNumBallValues, 1, scale_x, scale_y);
  const Grid posts(output, first += kNumRobotValues, 1, scale_x, scale_y);
  FoundObjects found;
  for (const Grid::Cell& cell : balls.peaks(kLeastBall)) {
    if (found.balls.size() == kMostBalls) break;
    found.balls.push_back({balls.point(1, cell, balls.size()), balls.radius(3, cell)});
  }
  for (const Grid::Cell& cell : posts.peaks(kLeastPost)) {
    const cv::Point2f foot = posts.point(1, cell, posts.size());
    const float radius = posts.radius(3, cell);
    Detection post;
    post.kind = Kind::kGoalPost;
    post.confidence = cell.probability;
    locate(foot, width, height, geometry, post);
    double top = 0;
    if (post.has_position()) {
      const auto head = geometry.project({post.position.x(), post.position.y(), kPostHeight});
      if (head) top = std::clamp<double>(head->y, 0, foot.y);
    }
    post.box_px = {foot.x - radius, top, foot.x + radius, foot.y};
    found.posts.push_back(post);
  }
  for (const Grid::Cell& cell : robots.peaks(kLeastRobot)) {
    const cv::Point2f middle = robots.middle(cell);
    const auto side = [&](int i) { return kBoxUnit * robots.value(i, cell); };
    Detection robot;
    robot.kind = Kind::kRobot;
    robot.confidence = cell.probability;
    robot.box_px = {std::max(0.0f, middle.x - scale_x * side(1)),
                    std::max(0.0f, middle.y - scale_y * side(2)),
                    std::min(width - 1.0f, middle.x + scale_x * side(3)),
                    std::min(height - 1.0f, middle.y + scale_y * side(4))};
    if (robot.box_px[2] <= robot.box_px[0] || robot.box_px[3] <= robot.box_px[1]) continue;
    const bool is_new = std::none_of(
        found.robots.begin(), found.robots.end(),
        [&](const Detection& other) { return overlap(other.box_px, robot.box_px) > kSameRobot; });
    if (!is_new) continue;
    locate(robots.point(5, cell, kBoxUnit), width, height, geometry, robot);
    found.robots.push_back(robot);
  }
  return found;
}

}  // namespace nao::vision
