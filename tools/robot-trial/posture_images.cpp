#include "tools/robot-trial/posture_images.h"

#include <Eigen/Geometry>
#include <cmath>

#include "rendering/egl_context.h"
#include "rendering/gl_objects.h"
#include "rendering/image.h"
#include "rendering/robot_visual.h"
#include "rendering/scene_renderer.h"
#include "robot_model/scene_file.h"

namespace nao {
namespace {

constexpr int kWidth = 480;             // pixels
constexpr int kHeight = 640;            // pixels
constexpr int kSamples = 2;             // along each edge of a pixel
constexpr double kHorizontalFov = 0.5;  // rad
// Direction from which the camera looks: from ahead, a little to the left and above.
const Eigen::Vector3d kFrom(1, 0.6, 0.35);
// Distance of the camera, in units of the radius of what it shows at this field of view.
constexpr double kDistance = 3.6;

/** Box about the links in the world, m; a link without shapes is its origin. */
Eigen::AlignedBox3d measure(const RobotModel& model, const std::vector<Eigen::Isometry3d>& poses) {
  Eigen::AlignedBox3d box;
  for (size_t i = 0; i < poses.size(); ++i) {
    box.extend(Eigen::Vector3d(poses[i].translation()));
    for (const Shape& shape : model.links()[i].collisions) {
      const double radius = shape.radius + 0.5 * shape.length + 0.5 * shape.size.norm();
      const Eigen::Vector3d center = (poses[i] * shape.pose_in_link).translation();
      box.extend(Eigen::Vector3d(center.array() - 0.7 * radius));
      box.extend(Eigen::Vector3d(center.array() + 0.7 * radius));
    }
  }
  return box;
}

Eigen::Isometry3d look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d x = (target - eye).normalized();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitZ().cross(x).normalized();
  pose.linear() << x, y, x.cross(y);
  pose.translation() = eye;
  return pose;
}

/** A file's name from a posture's: letters, digits and the like. */
std::string file_name(const std::string& posture) {
  std::string name;
  for (const char letter : posture) name += std::isalnum(letter & 0xff) != 0 ? letter : '_';
  return name + ".png";
}

}  // namespace

std::vector<std::string> draw_postures(const RobotModel& model,
                                       const std::filesystem::path& folder) {
  const EglContext context;
  SceneRenderer renderer({.shadow_size = 1024});
  renderer.set_surroundings(SceneFile::find("empty"));
  const RobotVisual visual(model, renderer);
  const int width = kSamples * kWidth;
  const int height = kSamples * kHeight;
  const gl::Framebuffer framebuffer(width, height);
  const PinholeCamera camera =
      PinholeCamera::from_fov(width, height, kHorizontalFov,
                              2 * std::atan(std::tan(0.5 * kHorizontalFov) * kHeight / kWidth));
  std::filesystem::create_directories(folder);
  std::vector<std::string> names;
  for (const Posture& posture : model.postures()) {
    const Eigen::Isometry3d sole = model.link_poses(posture.position)[model.left_sole()];
    const auto poses = link_poses_in_world(model, sole.inverse(), posture.position);
    Scene scene;
    visual.append(scene, poses);
    const Eigen::AlignedBox3d box = measure(model, poses);
    const Eigen::Vector3d eye =
        box.center() + kDistance * 0.5 * box.diagonal().norm() * kFrom.normalized();
    renderer.render(scene, camera, look_at(eye, box.center()), framebuffer.id());
    std::vector<uint8_t> pixels;
    framebuffer.read(pixels);
    names.push_back(file_name(posture.name));
    write_png(folder / names.back(), downsampled(image_from_bgrx(width, height, pixels), kSamples));
  }
  return names;
}

}  // namespace nao
