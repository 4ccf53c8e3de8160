#include "tools/vision-dataset/dataset_renderer.h"

#include <opencv2/imgproc.hpp>

#include "daemons/head-camera/head_camera.h"
#include "rendering/primitives.h"
#include "tools/vision-dataset/scene_labels.h"

namespace nao::vision {
namespace {

/** Size of the images, pixels: that of the images nao-vision works on. */
constexpr int kWidth = 640;
constexpr int kHeight = 480;

PinholeCamera pinhole(const RobotModel& model, const std::string& name) {
  for (const CameraModel& camera : model.cameras()) {
    if (camera.name == name) return camera::pinhole_of(camera);
  }
  return camera::pinhole_of(model.cameras().front());
}

}  // namespace

DatasetRenderer::DatasetRenderer(const RobotModel& model, const SceneFile& field)
    : model_(model),
      field_(field),
      renderer_(RendererOptions{.shadow_size = 512}),
      visual_(model, renderer_),
      framebuffer_(kWidth, kHeight),
      shapes_{renderer_.add_mesh(make_box(Eigen::Vector3f::Ones(), Color::Ones())),
              renderer_.add_mesh(make_cylinder(0.5f, 1, Color::Ones())),
              renderer_.add_mesh(make_sphere(0.5f, Color::Ones()))} {
  renderer_.set_surroundings(field);
}

void DatasetRenderer::append_robots(const RandomScene& scene, bool has_named_colors) {
  for (size_t i = 0; i < scene.robots.size(); ++i) {
    const PlacedRobot& robot = scene.robots[i];
    Color tint(robot.tint[0], robot.tint[1], robot.tint[2], 1);
    if (has_named_colors) tint = robot_name_color(i);
    visual_.append(scene_, link_poses_in_world(model_, robot.pose_torso_in_world, robot.position),
                   tint);
  }
}

void DatasetRenderer::append_distractors(const RandomScene& scene, bool has_named_colors) {
  for (const Distractor& distractor : scene.distractors) {
    MeshInstance instance;
    instance.mesh = shapes_[static_cast<size_t>(distractor.kind)];
    instance.pose_in_world = distractor.pose_in_world.cast<float>();
    instance.scale = distractor.size.cast<float>();
    instance.tint << distractor.color, 1;
    if (has_named_colors) instance.tint = Color(0, 0, 0, 1);
    // Objects far from the field would make the shadow map coarse.
    instance.casts_shadow = distractor.size.maxCoeff() < 1;
    scene_.instances.push_back(instance);
  }
}

cv::Mat DatasetRenderer::draw(const RandomScene& scene, const camera::Lens& lens,
                              bool has_named_colors) {
  scene_.clear();
  append_robots(scene, has_named_colors);
  append_distractors(scene, has_named_colors);
  if (scene.pose_ball_in_world) {
    const auto radius = static_cast<float>(field_.ball->radius);
    if (has_named_colors || scene.is_ball_plain) {
      MeshInstance ball;
      ball.mesh = shapes_[2];
      ball.pose_in_world = scene.pose_ball_in_world->cast<float>();
      ball.scale.setConstant(2 * radius);
      ball.tint << scene.ball_hexagons, 1;
      if (has_named_colors) ball.tint = ball_name_color();
      scene_.instances.push_back(ball);
    } else {
      scene_.ball = SceneBall{scene.pose_ball_in_world->cast<float>(), radius, scene.ball_hexagons,
                              scene.ball_pentagons};
    }
  }
  if (has_named_colors) {
    for (MeshInstance& instance : scene_.instances) instance.casts_shadow = false;
  }
  renderer_.set_appearance(has_named_colors ? named_appearance() : scene.appearance);
  renderer_.render(scene_, lens.source(), scene.pose_camera_in_world, framebuffer_.id());
  std::vector<uint8_t> ideal;
  std::vector<uint8_t> pixels;
  framebuffer_.read(ideal);
  lens.distort(ideal, pixels);
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(kHeight, kWidth, CV_8UC4, pixels.data()), bgr, cv::COLOR_BGRA2BGR);
  cv::flip(bgr, bgr, 0);
  return bgr;
}

cv::Mat DatasetRenderer::render(const RandomScene& scene, LabelledImage& labels) {
  const PinholeCamera camera = pinhole(model_, scene.camera);
  const camera::Lens lens(camera, scene.distortion);
  labels.width = kWidth;
  labels.height = kHeight;
  labels.calibration = CameraCalibration{camera.fx, camera.fy, camera.cx, camera.cy,
                                         scene.distortion.coefficients()};
  Eigen::Isometry3d heading = Eigen::Isometry3d::Identity();
  heading.translation().head<2>() = scene.heading_in_world.position;
  heading.linear() =
      Eigen::AngleAxisd(scene.heading_in_world.heading, Eigen::Vector3d::UnitZ()).matrix();
  labels.pose_camera_in_heading = heading.inverse() * scene.pose_camera_in_world;
  labels.labels = make_labels(scene, field_, labels, draw(scene, lens, true));
  cv::Mat bgr = draw(scene, lens, false);
  scene.effects.apply(bgr);
  return bgr;
}

}  // namespace nao::vision
