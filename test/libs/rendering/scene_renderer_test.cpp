#include "rendering/scene_renderer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "common/data_path.h"
#include "common/error.h"
#include "rendering/gl.h"
#include "rendering/primitives.h"
#include "rendering/robot_shirt.h"
#include "rendering/robot_visuals.h"
#include "test/libs/rendering/offscreen.h"
#include "test/support/read_png.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

const PinholeCamera kCamera = PinholeCamera::from_fov(320, 240, 1.06, 0.83);

/** Simple solids on the field, independent of the meshes of the robot. */
Scene solids(SceneRenderer& renderer) {
  Scene scene;
  const auto add = [&](const Mesh& mesh, const Eigen::Vector3f& at, float turn, const Color& tint) {
    MeshInstance instance;
    instance.mesh = renderer.add_mesh(mesh);
    instance.pose_in_world = Eigen::Translation3f(at) *
                             Eigen::AngleAxisf(turn, Eigen::Vector3f(0.3f, 1, 0.5f).normalized());
    instance.tint = tint;
    scene.instances.push_back(instance);
  };
  const Color white(0.8f, 0.8f, 0.8f, 1);
  add(make_box({0.2f, 0.3f, 0.1f}, white), {0, 0, 0.3f}, 0.4f, Color::Ones());
  add(make_capsule(0.05f, 0.2f, {0.8f, 0.3f, 0.1f, 1}), {0.1f, 0.3f, 0.2f}, 0.3f, Color::Ones());
  add(make_cylinder(0.06f, 0.2f, white), {-0.1f, -0.3f, 0.1f}, 0, {0.2f, 0.4f, 1, 1});
  add(make_sphere(0.1f, white), {0.3f, 0, 0.25f}, 0, {1, 1, 1, 0.4f});
  scene.ball = SceneBall{};
  scene.ball->pose_in_world =
      Eigen::Translation3f(0.4f, -0.3f, 0.05f) * Eigen::AngleAxisf(0.4f, Eigen::Vector3f(1, 0, 0));
  return scene;
}

Eigen::Isometry3d outside() {
  return look_at({1.3, 0.9, 0.7}, {0, -0.1, 0.2});
}

TEST(SceneRenderer, IsDeterministic) {
  Offscreen first;
  first.renderer.set_surroundings(SceneFile::find("soccer"));
  const Scene scene = solids(first.renderer);
  const Image image = first.draw(scene, kCamera, outside());
  first.draw({}, kCamera, look_at({0, 0, 1}, {-1, 0, 0}));  // another image in between
  EXPECT_EQ(first.draw(scene, kCamera, outside()).rgb, image.rgb);
}

/** Guards against unintended changes. Drivers round differently, so small differences are allowed:
 * a mean of 1.5 of 255, and more than 40 in 1 % of the values (edges). After an intended change run
 * the test with NAO_WRITE_IMAGES=test/libs/rendering/expected, which writes the new image, and look
 * at it. */
TEST(SceneRenderer, DrawsTheExpectedImage) {
  Offscreen offscreen;
  offscreen.renderer.set_surroundings(SceneFile::find("soccer"));
  const Image drawn = offscreen.draw(solids(offscreen.renderer), kCamera, outside());
  if (const char* folder = std::getenv("NAO_WRITE_IMAGES")) {
    write_png(std::filesystem::path(folder) / "solids.png", drawn);
  }
  const Image expected = read_png(std::filesystem::path(NAO_EXPECTED_IMAGES) / "solids.png");
  ASSERT_EQ(drawn.rgb.size(), expected.rgb.size());
  double sum = 0;
  int num_far = 0;
  for (size_t i = 0; i < drawn.rgb.size(); ++i) {
    const int difference = std::abs(drawn.rgb[i] - expected.rgb[i]);
    sum += difference;
    num_far += difference > 40 ? 1 : 0;
  }
  EXPECT_LT(sum / static_cast<double>(drawn.rgb.size()), 1.5);
  EXPECT_LT(num_far, static_cast<int>(drawn.rgb.size() / 100));
}

TEST(SceneRenderer, CullsWhatIsOutOfView) {
  Offscreen offscreen(RendererOptions{.shadow_size = 0});
  Scene scene;
  MeshInstance instance;
  instance.mesh = offscreen.renderer.add_mesh(make_sphere(0.1f, Color::Ones()));
  scene.instances.assign(10, instance);
  const Eigen::Isometry3d away = look_at({1, 0, 0.5}, {2, 0, 0.5});
  const Image empty = offscreen.draw({}, kCamera, away);
  const int num_draws = offscreen.statistics.num_draws;
  EXPECT_EQ(offscreen.draw(scene, kCamera, away).rgb, empty.rgb);
  EXPECT_EQ(offscreen.statistics.num_draws, num_draws);
  offscreen.draw(scene, kCamera, look_at({1, 0, 0.5}, {0, 0, 0.1}));
  EXPECT_EQ(offscreen.statistics.num_draws, num_draws + 10);
}

TEST(SceneRenderer, CullsBackFaces) {
  Offscreen offscreen(RendererOptions{.shadow_size = 0});
  Scene scene;
  MeshInstance instance;
  instance.mesh = offscreen.renderer.add_mesh(make_sphere(0.5f, Color::Ones()));
  instance.pose_in_world.translation().z() = 1;
  scene.instances.push_back(instance);
  const Eigen::Isometry3d inside = look_at({0, 0, 1}, {1, 0, 1});
  EXPECT_EQ(offscreen.draw(scene, kCamera, inside).rgb, offscreen.draw({}, kCamera, inside).rgb);
}

TEST(SceneRenderer, CastsShadowsAwayFromTheLight) {
  Offscreen offscreen;
  offscreen.renderer.set_surroundings(SceneFile::find("empty"));
  Scene scene;
  MeshInstance instance;
  instance.mesh = offscreen.renderer.add_mesh(make_box({0.2f, 0.2f, 0.2f}, Color::Ones()));
  instance.pose_in_world.translation().z() = 0.6f;
  scene.instances.push_back(instance);
  Scene unshadowed = scene;
  unshadowed.instances[0].casts_shadow = false;
  const Eigen::Isometry3d above = look_at({0, 0.01, 4}, {0, 0, 0});
  const Image with = offscreen.draw(scene, kCamera, above);
  const Image without = offscreen.draw(unshadowed, kCamera, above);
  // The shadow of a box above the origin is displaced by (-0.18, -0.42) / 0.85 of its height.
  const Eigen::Vector3d shadow(-0.6 * 0.18 / 0.85, -0.6 * 0.42 / 0.85, 0);
  const Eigen::Vector2d pixel = kCamera.project(above.inverse() * shadow);
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  EXPECT_LT(brightness(with, u, v), 0.85 * brightness(without, u, v));
  const Eigen::Vector2d mirrored = kCamera.project(above.inverse() * -shadow);
  EXPECT_EQ(difference(with, without, static_cast<int>(std::lround(mirrored.x())),
                       static_cast<int>(std::lround(mirrored.y()))),
            0);
}

/** Shadows on bodies are looked up at pixels near the camera, and at vertices farther away. */
TEST(SceneRenderer, CastsShadowsOnBodiesNearAndFar) {
  Offscreen offscreen;
  const MeshId ball = offscreen.renderer.add_mesh(make_sphere(0.1f, Color::Ones()));
  for (const double distance : {0.5, 3.0}) {
    Scene scene;
    MeshInstance body;
    body.mesh = ball;
    body.pose_in_world.translation().z() = 0.3f;
    scene.instances.push_back(body);
    const Eigen::Vector3d light = kLightDirection.cast<double>();
    const Eigen::Vector3d lit = Eigen::Vector3d(0, 0, 0.3) + 0.1 * light;
    const Eigen::Isometry3d pose = look_at(lit + distance * light, lit);
    const Image alone = offscreen.draw(scene, kCamera, pose);
    MeshInstance caster = body;
    caster.pose_in_world.translation() += (distance + 0.5) * kLightDirection;  // behind the camera
    scene.instances.push_back(caster);
    const Image shadowed = offscreen.draw(scene, kCamera, pose);
    const int u = kCamera.width / 2;
    const int v = kCamera.height / 2;
    EXPECT_LT(brightness(shadowed, u, v), brightness(alone, u, v) - 40) << distance << " m";
  }
}

TEST(SceneRenderer, BlendsTranslucentBodiesWithTheBackground) {
  Offscreen offscreen(RendererOptions{.shadow_size = 0});
  Scene scene;
  MeshInstance instance;
  instance.mesh = offscreen.renderer.add_mesh(make_box({0.3f, 0.3f, 0.3f}, {1, 0, 0, 1}));
  instance.pose_in_world.translation().z() = 0.5f;
  scene.instances.push_back(instance);
  const Eigen::Isometry3d pose = look_at({2, 0, 0.6}, {0, 0, 0.5});
  const Image behind = offscreen.draw({}, kCamera, pose);
  const Image opaque = offscreen.draw(scene, kCamera, pose);
  scene.instances[0].tint.w() = 0.5f;
  const Image through = offscreen.draw(scene, kCamera, pose);
  for (int channel = 0; channel < 3; ++channel) {
    const int mean = (behind.at(160, 120)[channel] + opaque.at(160, 120)[channel]) / 2;
    EXPECT_NEAR(through.at(160, 120)[channel], mean, 2);
  }
}

TEST(SceneRenderer, DoesNotDrawCoveredParts) {
  Offscreen offscreen;
  offscreen.renderer.set_surroundings(SceneFile::find("soccer"));
  const Scene scene = solids(offscreen.renderer);
  const Image whole = offscreen.draw(scene, kCamera, outside());
  const gl::Framebuffer framebuffer(kCamera.width, kCamera.height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glClearColor(1, 0, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  const PixelBox box{100, 60, 220, 200};  // rows from the bottom up
  offscreen.renderer.render(scene, kCamera, outside(), framebuffer.id(), {box});
  std::vector<uint8_t> pixels;
  framebuffer.read(pixels);
  const Image image = image_from_bgrx(kCamera.width, kCamera.height, pixels);
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const int row = kCamera.height - 1 - v;
      const bool is_covered = u >= box.left && u < box.right && row >= box.bottom && row < box.top;
      const uint8_t* drawn = whole.at(u, v);
      const uint8_t* pixel = image.at(u, v);
      ASSERT_EQ(pixel[0], is_covered ? 255 : drawn[0]) << u << ", " << v;
      ASSERT_EQ(pixel[1], is_covered ? 0 : drawn[1]) << u << ", " << v;
    }
  }
}

TEST(SceneRenderer, RejectsAnInvalidImageSize) {
  Offscreen offscreen;
  EXPECT_THROW(gl::Framebuffer(0, 480), Error);
  EXPECT_THROW(gl::Framebuffer(640, -1), Error);
  EXPECT_THROW(gl::Framebuffer(1 << 20, 480), Error);
}

TEST(RobotVisual, DrawsCollisionShapesForAMeshThatCannotBeRead) {
  const TemporaryFolder folder;
  std::filesystem::copy(data_path() / "robots" / "nao", folder.path(),
                        std::filesystem::copy_options::recursive);
  const RobotModel whole = RobotModel::load(folder.path());
  const std::filesystem::path mesh = whole.links()[whole.find_link("torso")].visuals.at(0).mesh;
  write_text(mesh, "damaged");
  const RobotModel model = RobotModel::load(folder.path());
  Offscreen offscreen(RendererOptions{.shadow_size = 0});
  const RobotVisual visual(model, offscreen.renderer);

  ASSERT_EQ(visual.problems().size(), 1u);
  EXPECT_NE(visual.problems()[0].find(mesh.filename().string()), std::string::npos);
  Scene scene;
  Eigen::Isometry3d torso = Eigen::Isometry3d::Identity();
  torso.translation().z() = 0.33;
  visual.append(scene,
                link_poses_in_world(model, torso, model.find_posture("StandInit")->position));
  const Eigen::Isometry3d pose = look_at({1, 0, 0.4}, {0, 0, 0.36});
  const Image with = offscreen.draw(scene, kCamera, pose);
  const Image without = offscreen.draw({}, kCamera, pose);
  EXPECT_GT(difference(with, without, 160, 120), 20) << "no chest in the middle of the image";
}

TEST(RobotVisual, DrawsTheLightsThatAreLit) {
  const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  Offscreen offscreen(RendererOptions{.shadow_size = 0});
  const RobotVisual visual(model, offscreen.renderer);
  Eigen::Isometry3d torso = Eigen::Isometry3d::Identity();
  torso.translation().z() = 0.33;
  const auto poses = link_poses_in_world(model, torso, model.find_posture("StandInit")->position);
  Scene scene;
  visual.append(scene, poses);
  // The chest's button, from 10 cm ahead of it.
  const Eigen::Isometry3d pose = look_at({0.17, 0, 0.383}, {0, 0, 0.383});
  const Image dark = offscreen.draw(scene, kCamera, pose);
  visual.append_lights(scene, poses, {{"chest", {1, 0, 0}}, {"tail", {0, 1, 0}}});
  const Image lit = offscreen.draw(scene, kCamera, pose);
  EXPECT_GT(difference(lit, dark, 160, 120), 60);
  // Not beside it, and not if its link is hidden.
  EXPECT_LT(difference(lit, dark, 20, 120), 2);
  Scene hidden;
  visual.append_lights(hidden, poses, {{"chest", {1, 0, 0}}}, model.find_link("torso"));
  EXPECT_TRUE(hidden.triangles.empty());
}

/** Pixels of a team's shirt: much more blue than red, or the other way round; and white ones. */
struct ShirtPixels {
  int blue = 0;
  int red = 0;
  int white = 0;
};

ShirtPixels count_shirt_pixels(const Image& image) {
  ShirtPixels count;
  for (int v = 60; v < 180; ++v) {
    for (int u = 100; u < 220; ++u) {
      const uint8_t* pixel = image.at(u, v);
      if (pixel[2] > 2 * pixel[0]) ++count.blue;
      if (pixel[0] > 2 * pixel[2]) ++count.red;
      if (std::min({pixel[0], pixel[1], pixel[2]}) > 240) ++count.white;
    }
  }
  return count;
}

TEST(RobotVisuals, DrawEveryModelWithTheShirtOfItsTeam) {
  const RobotModel own = RobotModel::load(data_path() / "robots" / "nao");
  const auto other =
      std::make_shared<const RobotModel>(RobotModel::load(data_path() / "robots/t1"));
  Offscreen offscreen(RendererOptions{.shadow_size = 0});
  RobotVisuals visuals(own, offscreen.renderer);
  for (const bool is_own : {true, false}) {
    const RobotModel& model = is_own ? own : *other;
    RobotPose robot;
    robot.name = "ROBOT";
    if (!is_own) robot.model = other;
    robot.position.assign(model.num_motors(), 0.0);
    robot.pose_torso_in_world.translation().z() = 1;
    const double distance = is_own ? 0.6 : 1.5;
    for (const double side : {1.0, -1.0}) {
      const Eigen::Isometry3d view = look_at({side * distance, 0, 1.02}, {0, 0, 1.02});
      const auto draw = [&](int team, int number) {
        robot.team = team;
        robot.number = number;
        Scene scene;
        visuals.append(scene, robot);
        return count_shirt_pixels(offscreen.draw(scene, kCamera, view));
      };
      const ShirtPixels none = draw(0, 0);
      const ShirtPixels blue = draw(0, 1);
      const ShirtPixels red = draw(1, 8);
      EXPECT_GT(blue.blue, none.blue + 300) << model.name() << side;
      EXPECT_GT(red.red, none.red + 300) << model.name() << side;
      EXPECT_LT(red.blue, none.blue + 50) << model.name() << side;
      EXPECT_GT(blue.white, none.white + 10) << model.name() << side;
      EXPECT_GT(red.white, blue.white + 20) << "8 has more strokes than 1";
    }
  }
}

TEST(RobotShirt, FollowsTheConvexOutlineOfTheTorso) {
  const RobotShirt shirt = make_shirt(make_box({0.2f, 0.1f, 0.4f}, Color::Ones()));
  ASSERT_FALSE(shirt.band.indices.empty());
  for (const Vertex& vertex : shirt.band.vertices) {
    EXPECT_NEAR(std::abs(vertex.position.x()), 0.1, 0.005);
    EXPECT_NEAR(std::abs(vertex.position.y()), 0.05, 0.005);
    EXPECT_GT(vertex.position.z(), -0.11);
    EXPECT_LT(vertex.position.z(), 0.09);
  }
  EXPECT_GT(shirt.front, 0.1);
  EXPECT_LT(shirt.back, -0.1);
  EXPECT_TRUE(make_shirt({}).band.indices.empty());
}

TEST(RobotVisual, HidesTheLinkThatCarriesTheCamera) {
  const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
  for (const CameraModel& camera : model.cameras()) {
    EXPECT_EQ(model.links()[carrying_link(model, camera.link)].name, "Head");
  }
}

}  // namespace
}  // namespace nao
