// Points with known positions in the world must appear at the pixels that the pinhole formula
// gives.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "common/data_path.h"
#include "rendering/robot_visual.h"
#include "robot_model/robot_model.h"
#include "test/libs/rendering/offscreen.h"

namespace nao {
namespace {

/** Allowed distance of a measured position from the computed one, pixels at 640x480. */
constexpr double kTolerance = 1.0;
/** Color difference from which a pixel counts as changed. */
constexpr int kChanged = 6;
/** Color difference between white posts and green carpet; nets and grey bars differ less. */
constexpr int kPost = 50;

/** Mean position of the pixels in which two images differ. */
std::optional<Eigen::Vector2d> center_of_change(const Image& a, const Image& b) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (int v = 0; v < a.height; ++v) {
    for (int u = 0; u < a.width; ++u) {
      if (difference(a, b, u, v) < kChanged) continue;
      sum += Eigen::Vector2d(u, v);
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

/** One camera of the robot, which stands near the center of the field with its head turned. */
struct View {
  std::string camera;
  double head_yaw;
  double head_pitch;
};

class KnownPixels : public testing::TestWithParam<View> {
 protected:
  KnownPixels()
      : model_(RobotModel::load(data_path() / "robots" / "nao")),
        scene_file_(SceneFile::find("soccer")),
        offscreen_(RendererOptions{.shadow_size = 0}) {
    offscreen_.renderer.set_surroundings(scene_file_);
    std::vector<double> position = model_.find_posture("StandInit")->position;
    position[model_.find_motor("HeadYaw")] = GetParam().head_yaw;
    position[model_.find_motor("HeadPitch")] = GetParam().head_pitch;
    Eigen::Isometry3d torso = Eigen::Isometry3d::Identity();
    torso.translate(Eigen::Vector3d(-0.4, 0.3, 0.32));
    torso.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()));
    const auto poses = link_poses_in_world(model_, torso, position);
    for (const CameraModel& camera : model_.cameras()) {
      if (camera.name != GetParam().camera) continue;
      pose_ = poses[camera.link];
      camera_ = PinholeCamera::from_fov(640, 480, camera.horizontal_fov, camera.vertical_fov);
    }
  }

  Eigen::Vector2d expected(const Eigen::Vector3d& point_in_world) const {
    return camera_.project(pose_.inverse() * point_in_world);
  }

  Image draw(const Scene& scene) { return offscreen_.draw(scene, camera_, pose_); }

  /** Point of the ground that a pixel shows. */
  Eigen::Vector3d on_ground(double u, double v) const {
    const Eigen::Vector3d ray = pose_.linear() * camera_.ray({u, v});
    return pose_.translation() - ray * (pose_.translation().z() / ray.z());
  }

  const RobotModel model_;
  const SceneFile scene_file_;
  Offscreen offscreen_;
  PinholeCamera camera_;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
};

TEST_P(KnownPixels, BallCenter) {
  // On the plain floor: a white ball on a white line has no outline.
  offscreen_.renderer.set_surroundings(SceneFile::find("empty"));
  const Image without = draw({});
  // Straight ahead, and towards each corner of the image that shows the ground.
  int num_seen = 0;
  for (const auto& [u, v] : {std::pair{320, 300}, {80, 380}, {560, 400}, {120, 60}, {500, 50}}) {
    Eigen::Vector3d ground = on_ground(u, v);
    const double distance = (ground - pose_.translation()).norm();
    if (!(distance < 8) || (pose_.inverse() * ground).x() < 0) continue;
    // Small, so that the middle of its outline is the image of its center: the difference is about
    // f tan(angle) (radius / distance)^2, below 0.1 pixel.
    const double radius = 0.012 * distance;
    ground.z() = radius;
    Scene scene;
    scene.ball = SceneBall{};
    scene.ball->radius = static_cast<float>(radius);
    scene.ball->pose_in_world.translation() = ground.cast<float>();
    const auto center = center_of_change(draw(scene), without);
    ASSERT_TRUE(center) << u << ", " << v;
    EXPECT_LT((*center - expected(ground)).norm(), kTolerance)
        << "seen at " << center->transpose() << ", expected at " << expected(ground).transpose();
    ++num_seen;
  }
  EXPECT_GE(num_seen, 2);
}

/** Whether a point of the ground (m) is white. Independent of the renderer, from the rules:
 * segments between the middles of lines 5 cm wide, and a circle. */
bool is_on_line(const Eigen::Vector2d& point) {
  const Eigen::Vector2d q = point.cwiseAbs();
  const auto is_near = [&](double x0, double y0, double x1, double y1) {
    return q.x() > x0 - 0.025 && q.x() < x1 + 0.025 && q.y() > y0 - 0.025 && q.y() < y1 + 0.025;
  };
  return is_near(0, 0, 0, 3) || is_near(0, 3, 4.5, 3) || is_near(4.5, 0, 4.5, 3) ||
         is_near(2.85, 0, 2.85, 2) || is_near(2.85, 2, 4.5, 2) || is_near(3.9, 0, 3.9, 1.1) ||
         is_near(3.9, 1.1, 4.5, 1.1) || std::abs(q.norm() - 0.75) < 0.025;
}

/** Part of an image, one value a pixel. */
using Window = Eigen::ArrayXXd;
constexpr int kWindowWidth = 41;
constexpr int kWindowHeight = 21;

/** Normalized correlation: 1 if two windows differ only in brightness and contrast. */
double correlation(const Window& a, const Window& b) {
  const Window x = a - a.mean();
  const Window y = b - b.mean();
  return (x * y).sum() / std::sqrt((x * x).sum() * (y * y).sum());
}

TEST_P(KnownPixels, CrossingsOfLines) {
  SceneFile without_goals = scene_file_;
  without_goals.goals.reset();
  offscreen_.renderer.set_surroundings(without_goals);
  const Image image = draw({});

  // The fraction of a pixel that is line, by the pinhole formula.
  const auto expected_fraction = [&](const Eigen::Vector2d& pixel) {
    constexpr int kSamples = 6;
    int count = 0;
    for (int i = 0; i < kSamples * kSamples; ++i) {
      const int row = i / kSamples;
      const int column = i % kSamples;
      const Eigen::Vector2d offset((column + 0.5) / kSamples - 0.5, (row + 0.5) / kSamples - 0.5);
      const Eigen::Vector2d at = pixel + offset;
      count += is_on_line(on_ground(at.x(), at.y()).head<2>()) ? 1 : 0;
    }
    return static_cast<double>(count) / (kSamples * kSamples);
  };

  int num_crossings = 0;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(2.85, 2), {3.9, 1.1}, {0, 3}, {4.5, 3}, {0, 0.75}, {4.5, 2}}) {
    for (const auto& [end, side] : {std::pair{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
      const Eigen::Vector3d place(end * corner.x(), side * corner.y(), 0);
      if ((pose_.inverse() * place).x() < 0.1) continue;
      const Eigen::Vector2d wanted = expected(place);
      const int left = static_cast<int>(std::lround(wanted.x())) - kWindowWidth / 2;
      const int top = static_cast<int>(std::lround(wanted.y())) - kWindowHeight / 2;
      if (left < 0 || top < 0 || left + kWindowWidth > 640 || top + kWindowHeight > 480) continue;
      if (on_ground(left, top).cwiseAbs().x() > 5.1 || std::abs(on_ground(left, top).y()) > 3.6 ||
          on_ground(left + kWindowWidth, top).cwiseAbs().x() > 5.1 ||
          std::abs(on_ground(left + kWindowWidth, top).y()) > 3.6) {
        continue;  // beyond the carpet
      }

      Window seen(kWindowHeight, kWindowWidth);
      for (int v = 0; v < kWindowHeight; ++v) {
        for (int u = 0; u < kWindowWidth; ++u) {
          // Red distinguishes white lines from green carpet best; screen values are square roots.
          seen(v, u) = std::pow(image.at(left + u, top + v)[0], 2);
        }
      }
      double best = -1;
      Eigen::Vector2d best_shift = Eigen::Vector2d::Zero();
      for (double dv = -2; dv <= 2; dv += 0.25) {
        for (double du = -2; du <= 2; du += 0.25) {
          Window formula(kWindowHeight, kWindowWidth);
          for (int v = 0; v < kWindowHeight; ++v) {
            for (int u = 0; u < kWindowWidth; ++u) {
              formula(v, u) = expected_fraction({left + u - du, top + v - dv});
            }
          }
          const double value = correlation(seen, formula);
          if (value > best) {
            best = value;
            best_shift = {du, dv};
          }
        }
      }
      EXPECT_LT(best_shift.norm(), kTolerance) << "crossing at " << place.transpose() << " m";
      EXPECT_GT(best, 0.97) << "crossing at " << place.transpose() << " m looks different";
      ++num_crossings;
    }
  }
  if (GetParam().camera == "top") {
    EXPECT_GE(num_crossings, 1);
  }
}

TEST_P(KnownPixels, FeetOfTheGoalPosts) {
  // Only green behind the posts: no white lines, no grey hall.
  SceneFile green = scene_file_;
  green.field->line_width = 1e-4;
  green.field->border_strip_width = 30;
  offscreen_.renderer.set_surroundings(green);
  const Image with = draw({});
  green.goals.reset();
  offscreen_.renderer.set_surroundings(green);
  const Image without = draw({});
  int num_posts = 0;
  for (const double sign : {-1.0, 1.0}) {
    for (const double side : {-1.0, 1.0}) {
      // A little above the ground, so that the whole width of the post is visible.
      const Eigen::Vector3d foot(sign * 4.525, side * 0.8, 0.03);
      const Eigen::Vector3d in_camera = pose_.inverse() * foot;
      if (in_camera.x() < 0.1) continue;
      const Eigen::Vector2d wanted = camera_.project(in_camera);
      if (wanted.x() < 30 || wanted.x() > 610 || wanted.y() < 10 || wanted.y() > 470) continue;
      const int row = static_cast<int>(std::lround(wanted.y()));
      const double half_width = camera_.fx * 0.05 / in_camera.x();
      double sum = 0;
      int count = 0;
      for (int u = static_cast<int>(wanted.x() - half_width - 2);
           u <= static_cast<int>(wanted.x() + half_width + 2); ++u) {
        if (difference(with, without, u, row) < kPost) continue;
        sum += u;
        ++count;
      }
      ASSERT_GT(count, 0);
      EXPECT_NEAR(sum / count, wanted.x(), kTolerance);
      EXPECT_NEAR(count, 2 * half_width, 3);
      ++num_posts;
    }
  }
  if (GetParam().camera == "top" && std::abs(GetParam().head_yaw) < 0.1) {
    EXPECT_EQ(num_posts, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Cameras, KnownPixels,
                         testing::Values(View{"top", 0, 0}, View{"top", 0.5, -0.1},
                                         View{"top", -0.45, 0.15}, View{"top", 1.3, 0.1},
                                         View{"bottom", 0, 0}, View{"bottom", 0.6, -0.4}),
                         [](const testing::TestParamInfo<View>& info) {
                           return info.param.camera + std::to_string(info.index);
                         });

}  // namespace
}  // namespace nao
