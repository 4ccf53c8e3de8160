#include "tools/vision-dataset/random_scene.h"

#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "daemons/vision/field_model.h"
#include "kinematics/pose2.h"
#include "tools/vision-dataset/hard_scene.h"
#include "tools/vision-dataset/scene_objects.h"

namespace nao::vision {
namespace {

/** Light and carpet of a place. */
SceneAppearance make_appearance(Random& random) {
  SceneAppearance look;
  const double azimuth = random.uniform(0, 2 * M_PI);
  const double elevation = random.uniform(40, 85) * kDegree;
  look.light_direction =
      Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
          .cast<float>();
  look.direct_light *= static_cast<float>(random.uniform(0.4, 1.4));
  look.ambient_light *= static_cast<float>(random.uniform(0.4, 1.1));
  // From dark saturated to pale yellowish green.
  const double green = random.uniform(0.10, 0.34);
  const double pale = random.uniform(0.15, 0.72);
  look.carpet = Eigen::Vector3d(green * pale * random.uniform(0.75, 1.1), green,
                                green * pale * random.uniform(0.55, 1.0))
                    .cast<float>();
  look.line = Eigen::Vector3f::Constant(static_cast<float>(random.uniform(0.5, 0.85)));
  if (random.uniform() < 0.5) look.line_wear = static_cast<float>(random.uniform(0, 0.6));
  look.carpet_texture = static_cast<float>(random.uniform(0, 0.35));
  if (random.uniform() < 0.4) {
    const double angle = random.uniform(0, 2 * M_PI);
    look.shade = Eigen::Vector4d(std::cos(angle), std::sin(angle), random.uniform(-2, 2),
                                 random.uniform(0.2, 1.5))
                     .cast<float>();
    look.shade_depth = static_cast<float>(random.uniform(0.4, 1));
  }
  return look;
}

/** Banners, walls and people around the carpet. */
void add_surroundings(RandomScene& scene, const FieldDimensions& field, Random& random) {
  const double x = field.length / 2 + field.border_strip_width + random.uniform(0.1, 0.6);
  const double y = field.width / 2 + field.border_strip_width + random.uniform(0.1, 0.6);
  const Eigen::Vector3f wall = random_color(random, 0.05, 0.8);
  for (const double sign : {-1.0, 1.0}) {
    add_box(scene, {sign * (x + 4), 0, 2}, 0, {0.1, 4 * y, 4}, wall);
    add_box(scene, {0, sign * (y + 4), 2}, 0, {4 * x, 0.1, 4}, wall);
  }
  const int num_banners = static_cast<int>(random.uniform(0, 22));
  for (int i = 0; i < num_banners; ++i) {
    const bool is_end = random.uniform() < 0.4;
    const double sign = random.uniform() < 0.5 ? -1 : 1;
    const double along = random.uniform(-1, 1);
    const Eigen::Vector3f color =
        random.uniform() < 0.5 ? Eigen::Vector3f::Constant(0.8f) : random_color(random, 0.02, 0.9);
    const Eigen::Vector3d size(random.uniform(0.8, 2), 0.05, random.uniform(0.3, 0.9));
    if (is_end) {
      add_box(scene, {sign * x, along * y, size.z() / 2}, M_PI / 2, size, color);
    } else {
      add_box(scene, {along * x, sign * y, size.z() / 2}, 0, size, color);
    }
  }
  const int num_people = static_cast<int>(random.uniform(0, 8));
  for (int i = 0; i < num_people; ++i) {
    const double sign = random.uniform() < 0.5 ? -1 : 1;
    add_person(scene, {random.uniform(-x, x), sign * (y + random.uniform(-0.3, 0.8))}, random);
  }
}

/** Bags, cables, chairs: boxes, cylinders and spheres beside the carpet, many black or white. */
void add_clutter(RandomScene& scene, const FieldDimensions& field, Random& random) {
  const int count = static_cast<int>(random.uniform(0, 24));
  for (int i = 0; i < count; ++i) {
    Distractor object;
    object.kind = static_cast<Distractor::Kind>(random.next() % 3);
    object.size = {random.uniform(0.05, 0.5), random.uniform(0.05, 0.5), random.uniform(0.05, 0.6)};
    if (object.kind == Distractor::Kind::kSphere) object.size.setConstant(random.uniform(0.1, 0.4));
    const double beyond = field.border_strip_width + random.uniform(0, 2.5);
    const bool is_end = random.uniform() < 0.4;
    const double sign = random.uniform() < 0.5 ? -1 : 1;
    const double along = random.uniform(-0.5, 0.5);
    object.pose_in_world.translation()
        << (is_end ? sign * (field.length / 2 + beyond) : along * field.length),
        (is_end ? along * field.width : sign * (field.width / 2 + beyond)), object.size.z() / 2;
    object.pose_in_world.linear() =
        Eigen::AngleAxisd(random.uniform(-M_PI, M_PI), Eigen::Vector3d::UnitZ()).matrix();
    const double kind = random.uniform();
    object.color = kind < 0.3   ? Eigen::Vector3f(Eigen::Vector3f::Constant(0.02f))
                   : kind < 0.6 ? Eigen::Vector3f(Eigen::Vector3f::Constant(0.8f))
                                : random_color(random, 0.02, 0.9);
    scene.distractors.push_back(object);
  }
}

void place_camera(RandomScene& scene, const FieldDimensions& field, Random& random) {
  scene.heading_in_world.position = {random.uniform(-0.5, 0.5) * (field.length + 0.6),
                                     random.uniform(-0.5, 0.5) * (field.width + 0.6)};
  scene.heading_in_world.heading = random.uniform(-M_PI, M_PI);
  const bool is_top = random.uniform() < 0.75;
  scene.camera = is_top ? "top" : "bottom";
  // Head pitch and yaw, and what walking adds.
  const double pitch = (is_top ? random.uniform(0, 32) : random.uniform(32, 62)) * kDegree;
  const double yaw = scene.heading_in_world.heading + random.uniform(-50, 50) * kDegree;
  scene.pose_camera_in_world.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(2.5 * kDegree * random.normal(), Eigen::Vector3d::UnitX()))
          .matrix();
  const Eigen::Vector2d position =
      scene.heading_in_world * Eigen::Vector2d(0.06, random.uniform(-0.03, 0.03));
  scene.pose_camera_in_world.translation() << position.x(), position.y(),
      random.uniform(is_top ? 0.46 : 0.42, 0.54);
}

/** A point on the ground in the view, m in the world. */
Eigen::Vector2d place_in_view(const RandomScene& scene, double nearest, double farthest,
                              Random& random) {
  const Eigen::Matrix3d R = scene.pose_camera_in_world.linear();
  // The distances that the camera's vertical field of view, 48 degrees, covers.
  const double pitch = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  const double height = scene.pose_camera_in_world.translation().z();
  const double lower = height / std::tan(std::min(1.5, pitch + 22 * kDegree));
  const double upper = pitch > 25 * kDegree ? height / std::tan(pitch - 22 * kDegree) : farthest;
  const double distance =
      random.uniform(std::max(nearest, lower), std::max(nearest + 0.1, std::min(farthest, upper)));
  const double bearing = heading_of(R) + random.uniform(-29, 29) * kDegree;
  return scene.pose_camera_in_world.translation().head<2>() +
         distance * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
}

/** A point of the field's lines in the view, m in the world; nothing if none was found. */
std::optional<Eigen::Vector2d> place_at_line(const RandomScene& scene, const FieldModel& field,
                                             double nearest, double farthest, Random& random) {
  const Eigen::Vector2d eye = scene.pose_camera_in_world.translation().head<2>();
  const double bearing = heading_of(scene.pose_camera_in_world.linear());
  for (int i = 0; i < 30; ++i) {
    const FieldLine& line = field.lines()[random.next() % field.lines().size()];
    // Beside the line by up to a ball's width.
    const Eigen::Vector2d place =
        line.from + random.uniform() * (line.to - line.from) +
        Eigen::Vector2d(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
    const Eigen::Vector2d way = place - eye;
    const double side = wrapped(std::atan2(way.y(), way.x()) - bearing);
    if (way.norm() > nearest && way.norm() < farthest && std::abs(side) < 28 * kDegree) {
      return place;
    }
  }
  return std::nullopt;
}

void add_objects(RandomScene& scene, const RobotModel& model, const SceneFile& file,
                 const SceneOptions& options, Random& random) {
  const double radius = file.ball ? file.ball->radius : 0.05;
  if (random.uniform() < options.ball_fraction) {
    // A quarter of the balls is at a line, where they are harder to find.
    std::optional<Eigen::Vector2d> at_line;
    if (random.uniform() < 0.25) {
      at_line = place_at_line(scene, FieldModel(file), 0.15, 5.2, random);
    }
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d place =
          at_line && i == 0 ? *at_line : place_in_view(scene, 0.15, 5.2, random);
      if (!is_on_carpet(place, *file.field)) continue;
      place_ball(scene, place, radius, random);
      break;
    }
  }
  const int num_robots = static_cast<int>(random.uniform(0, options.most_robots + 1));
  for (int i = 0; i < num_robots; ++i) {
    Eigen::Vector2d place = place_in_view(scene, 0.5, 5, random);
    // A third of them is at the ball.
    if (scene.pose_ball_in_world && random.uniform() < 0.33) {
      const double angle = random.uniform(-M_PI, M_PI);
      place = scene.pose_ball_in_world->translation().head<2>() +
              random.uniform(0.2, 0.5) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    const Eigen::Vector2d eye = scene.pose_camera_in_world.translation().head<2>();
    const bool is_free =
        std::all_of(scene.robots.begin(), scene.robots.end(),
                    [&](const PlacedRobot& other) { return (other.place - place).norm() > 0.35; });
    if (!is_free || (place - eye).norm() < 0.4 || !is_on_carpet(place, *file.field) ||
        (scene.pose_ball_in_world &&
         (place - scene.pose_ball_in_world->translation().head<2>()).norm() < 0.18)) {
      continue;
    }
    scene.robots.push_back(place_robot(model, place, random));
  }
  // Sometimes a person walks on the field.
  if (random.uniform() < 0.12) add_person(scene, place_in_view(scene, 1.2, 6, random), random);
}

}  // namespace

RandomScene make_scene(const RobotModel& model, const SceneFile& field, const SceneOptions& options,
                       uint64_t place, uint64_t image) {
  Random of_place(0x9f1ace00u + place);
  Random of_image(0x1a6e0000u + 1000003u * place + image +
                  (static_cast<uint64_t>(options.kind) << 40));
  RandomScene scene;
  scene.appearance = make_appearance(of_place);
  add_surroundings(scene, *field.field, of_place);
  scene.effects = ImageEffects::of_place(of_place);
  scene.distortion.k1 = of_place.uniform(-0.12, 0.06);
  add_clutter(scene, *field.field, of_place);
  if (options.kind == SceneKind::kMixed) {
    place_camera(scene, *field.field, of_image);
    add_objects(scene, model, field, options, of_image);
  } else {
    // From new to worn and dirty: faces of nearly one grey to white and black.
    scene.ball_hexagons =
        static_cast<float>(of_place.uniform(0.45, 0.9)) * random_color(of_place, 0.85, 1);
    scene.ball_pentagons = static_cast<float>(std::exp(of_place.uniform(-4.6, -1.5)));
    add_hard_objects(scene, model, field, options.kind, of_image);
  }
  scene.effects.vary(of_image);
  if (options.kind != SceneKind::kMixed) vary_exposure(scene, options.kind, of_image);
  return scene;
}

}  // namespace nao::vision
