#include "tools/vision-dataset/scene_labels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "daemons/vision/field_model.h"

namespace nao::vision {
namespace {

/** Distance between the points at which lines and posts are checked for visibility, m. */
constexpr double kStep = 0.04;
/** Greatest distance of labelled lines, m: farther ones are less than a pixel wide. */
constexpr double kLineReach = 6;
/** Shortest labelled piece of a line, pixels. */
constexpr double kLeastLine = 24;

using IsNamed = std::function<bool(const cv::Vec3b&)>;

bool is_white(const cv::Vec3b& c) {
  return c[0] > 100 && c[1] > 100 && c[2] > 100;
}
bool is_ball(const cv::Vec3b& c) {
  return c[0] > 60 && c[2] > 60 && 2 * c[1] < std::min(c[0], c[2]);
}
bool is_robot(const cv::Vec3b& c, size_t robot) {
  const int own = c[2 - robot];
  const int other = std::max(c[(3 - robot) % 3], c[(4 - robot) % 3]);
  return own > 25 && 2 * other < own;
}

/** Box and number of the pixels of a name, those of `within` only. */
struct Region {
  Eigen::Vector4d box{1e9, 1e9, -1, -1};
  int num_pixels = 0;
};

Region find(const cv::Mat& named, const IsNamed& is_named) {
  Region region;
  for (int y = 0; y < named.rows; ++y) {
    for (int x = 0; x < named.cols; ++x) {
      if (!is_named(named.at<cv::Vec3b>(y, x))) continue;
      ++region.num_pixels;
      region.box = {std::min<double>(region.box[0], x), std::min<double>(region.box[1], y),
                    std::max<double>(region.box[2], x + 1), std::max<double>(region.box[3], y + 1)};
    }
  }
  return region;
}

class Labeller {
 public:
  Labeller(const RandomScene& scene, const SceneFile& file, const LabelledImage& image,
           const cv::Mat& named)
      : scene_(scene),
        file_(file),
        field_(file),
        named_(named),
        geometry_(*image.calibration, image.pose_camera_in_heading),
        world_in_heading_(scene.heading_in_world.inverse()) {}

  std::vector<Label> make() {
    add_ball();
    for (size_t i = 0; i < scene_.robots.size(); ++i) add_robot(i);
    add_lines();
    add_posts();
    return std::move(labels_);
  }

 private:
  void add_ball() {
    if (!scene_.pose_ball_in_world) return;
    const Region region = find(named_, is_ball);
    if (region.num_pixels < 4) return;
    Label label;
    label.object.kind = Kind::kBall;
    const Eigen::Vector3d center = scene_.pose_ball_in_world->translation();
    const double radius = file_.ball->radius;
    label.object.position = world_in_heading_ * Eigen::Vector2d(center.head<2>());
    const auto pixel =
        geometry_.project({label.object.position.x(), label.object.position.y(), radius});
    if (!pixel) return;
    const double r = geometry_.sphere_radius_px(*pixel, radius).value_or(0);
    label.object.box_px = {pixel->x - r, pixel->y - r, pixel->x + r, pixel->y + r};
    label.visible = std::min(1.0, region.num_pixels / (M_PI * r * r));
    labels_.push_back(label);
  }

  void add_robot(size_t i) {
    const Region region = find(named_, [i](const cv::Vec3b& c) { return is_robot(c, i); });
    if (region.num_pixels < 60) return;
    Label label;
    label.object.kind = Kind::kRobot;
    label.object.box_px = region.box;
    label.object.position = world_in_heading_ * scene_.robots[i].place;
    // Its feet must be in the image for a position; a robot's upright outline fills about a third
    // of the box of its height.
    const auto foot =
        geometry_.project({label.object.position.x(), label.object.position.y(), 0.02});
    const bool is_foot_in_view = foot && foot->y < static_cast<float>(named_.rows - 1) &&
                                 foot->x > 0 && foot->x < static_cast<float>(named_.cols);
    const double height = region.box[3] - region.box[1];
    const double whole =
        geometry_.sphere_radius_px(foot.value_or(cv::Point2f(0, 0)), 0.05).value_or(1) * 10;
    label.visible = is_foot_in_view ? std::min(1.0, height / whole) : 0.3;
    labels_.push_back(label);
  }

  /** A pixel in the image where the named image is white at a point (m, in H). */
  std::optional<cv::Point2f> white_pixel(const Eigen::Vector3d& point) const {
    const auto pixel = geometry_.project(point);
    if (!pixel || pixel->x < 1 || pixel->y < 1 || pixel->x > static_cast<float>(named_.cols - 2) ||
        pixel->y > static_cast<float>(named_.rows - 2)) {
      return std::nullopt;
    }
    const bool white = is_white(named_.at<cv::Vec3b>(static_cast<int>(std::lround(pixel->y)),
                                                     static_cast<int>(std::lround(pixel->x))));
    if (!white) return std::nullopt;
    return pixel;
  }

  /** A line of the field, m in the world: its visible pieces. */
  void add_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const int num_steps = std::max(1, static_cast<int>((to - from).norm() / kStep));
    std::optional<cv::Point2f> first;
    cv::Point2f last;
    Eigen::Vector2d first_ground;
    Eigen::Vector2d last_ground;
    int num_missing = 0;
    const auto finish = [&] {
      if (first && cv::norm(last - *first) >= kLeastLine) {
        Label label;
        label.object.kind = Kind::kLine;
        label.object.line_px = {first->x, first->y, last.x, last.y};
        label.object.box_px = {std::min(first->x, last.x), std::min(first->y, last.y),
                               std::max(first->x, last.x), std::max(first->y, last.y)};
        label.object.position = first_ground;
        label.object.end = last_ground;
        labels_.push_back(label);
      }
      first.reset();
    };
    for (int i = 0; i <= num_steps; ++i) {
      const Eigen::Vector2d ground =
          world_in_heading_ * Eigen::Vector2d(from + (to - from) * i / num_steps);
      const auto pixel =
          ground.norm() > kLineReach ? std::nullopt : white_pixel({ground.x(), ground.y(), 0});
      if (!pixel) {
        // Aliasing hides single points.
        if (++num_missing > 2) finish();
        continue;
      }
      num_missing = 0;
      if (!first) {
        first = pixel;
        first_ground = ground;
      }
      last = *pixel;
      last_ground = ground;
    }
    finish();
  }

  void add_crossing(Kind kind, const Eigen::Vector2d& position) {
    Label label;
    label.object.kind = kind;
    label.object.position = world_in_heading_ * position;
    if (label.object.position.norm() > kLineReach) return;
    const auto pixel = white_pixel({label.object.position.x(), label.object.position.y(), 0});
    if (!pixel) return;
    label.object.box_px = {pixel->x - 8, pixel->y - 8, pixel->x + 8, pixel->y + 8};
    // It can be distinguished from a line only if a part of its arms is in view.
    const bool is_inside = pixel->x > 24 && pixel->y > 24 &&
                           pixel->x < static_cast<float>(named_.cols - 24) &&
                           pixel->y < static_cast<float>(named_.rows - 24);
    label.visible = is_inside ? 1 : 0.5;
    labels_.push_back(label);
  }

  void add_lines() {
    for (const FieldLine& line : field_.lines()) add_line(line.from, line.to);
    for (const FieldCrossing& crossing : field_.crossings()) {
      add_crossing(crossing.kind, crossing.position);
    }
    add_circle();
  }

  void add_circle() {
    Label label;
    label.object.kind = Kind::kCenterCircle;
    label.object.position = world_in_heading_ * Eigen::Vector2d(0, 0);
    // One in 5 degrees.
    constexpr int kNumPoints = 72;
    int num_visible = 0;
    Eigen::Vector4d box(1e9, 1e9, -1, -1);
    for (int i = 0; i < kNumPoints; ++i) {
      const double angle = 2 * M_PI * i / kNumPoints;
      const double radius = file_.field->centre_circle_diameter / 2;
      const Eigen::Vector2d ground =
          world_in_heading_ * Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
      const auto pixel = white_pixel({ground.x(), ground.y(), 0});
      if (!pixel) continue;
      ++num_visible;
      box = {std::min<double>(box[0], pixel->x), std::min<double>(box[1], pixel->y),
             std::max<double>(box[2], pixel->x), std::max<double>(box[3], pixel->y)};
    }
    if (num_visible < kNumPoints / 8) return;
    label.object.box_px = box;
    label.visible = static_cast<double>(num_visible) / kNumPoints;
    labels_.push_back(label);
  }

  void add_posts() {
    for (const Eigen::Vector2d& post : field_.goal_posts()) {
      const Eigen::Vector2d ground = world_in_heading_ * post;
      // From the foot to the top: one in 4 cm of a post of 0.8 m.
      constexpr int kNumPoints = 20;
      int num_visible = 0;
      bool is_foot_visible = false;
      Eigen::Vector4d box(1e9, 1e9, -1, -1);
      for (int i = 0; i < kNumPoints; ++i) {
        const double z = file_.goals->crossbar_height * i / kNumPoints;
        const auto pixel = white_pixel({ground.x(), ground.y(), z});
        if (!pixel) continue;
        ++num_visible;
        is_foot_visible |= i < 3;
        box = {std::min<double>(box[0], pixel->x - 4), std::min<double>(box[1], pixel->y),
               std::max<double>(box[2], pixel->x + 4), std::max<double>(box[3], pixel->y)};
      }
      if (num_visible == 0 || ground.norm() > kLineReach) continue;
      Label label;
      label.object.kind = Kind::kGoalPost;
      label.object.position = ground;
      label.object.box_px = box;
      label.visible = is_foot_visible ? 1 : 0.3;
      labels_.push_back(label);
    }
  }

  const RandomScene& scene_;
  const SceneFile& file_;
  FieldModel field_;
  const cv::Mat& named_;
  CameraGeometry geometry_;
  Pose2 world_in_heading_;
  std::vector<Label> labels_;
};

}  // namespace

Color robot_name_color(size_t robot) {
  // Factor 3: dark parts of a robot are recognized too.
  Color color(0, 0, 0, 1);
  color[static_cast<int>(robot % 3)] = 3;
  return color;
}

Color ball_name_color() {
  return {1, 0, 1, 1};
}

SceneAppearance named_appearance() {
  SceneAppearance look;
  look.light_direction = Eigen::Vector3f::UnitZ();
  look.carpet.setZero();
  look.line.setOnes();
  return look;
}

std::vector<Label> make_labels(const RandomScene& scene, const SceneFile& field,
                               const LabelledImage& image, const cv::Mat& named) {
  return Labeller(scene, field, image, named).make();
}

}  // namespace nao::vision
