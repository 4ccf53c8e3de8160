#include "tools/vision-dataset/hard_scene.h"

#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "daemons/vision/field_model.h"
#include "tools/vision-dataset/scene_objects.h"

namespace nao::vision {
namespace {

Eigen::Vector2d direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

template <typename Value>
const Value& any_of(const std::vector<Value>& values, Random& random) {
  return values[random.next() % values.size()];
}

/** Where the thing of a kind is: m, in the world. */
Eigen::Vector2d draw_target(const SceneFile& file, SceneKind kind, Random& random) {
  const FieldModel field(file);
  const FieldDimensions& size = *file.field;
  switch (kind) {
    case SceneKind::kBallOnLine: {
      if (random.uniform() < 0.3) {
        return field.circle_radius() * direction(random.uniform(-M_PI, M_PI));
      }
      const FieldLine& line = any_of(field.lines(), random);
      const Eigen::Vector2d along = (line.to - line.from).normalized();
      return line.from + random.uniform() * (line.to - line.from) +
             random.uniform(-0.05, 0.05) * Eigen::Vector2d(-along.y(), along.x());
    }
    case SceneKind::kBallOnMark:
    case SceneKind::kCrossing: {
      std::vector<Eigen::Vector2d> marks = {{0, 0}};
      for (const double sign : {-1.0, 1.0}) {
        marks.emplace_back(sign * (0.5 * size.length - size.penalty_mark_distance), 0);
        marks.emplace_back(0, sign * field.circle_radius());
      }
      for (const FieldCrossing& crossing : field.crossings()) marks.push_back(crossing.position);
      const double off = kind == SceneKind::kCrossing ? 0 : 0.04;
      return any_of(marks, random) + off * Eigen::Vector2d(random.normal(), random.normal());
    }
    case SceneKind::kBallAtPost:
      return any_of(field.goal_posts(), random) +
             random.uniform(0.1, 0.25) * direction(random.uniform(-M_PI, M_PI));
    case SceneKind::kGoalFoot: {
      const Eigen::Vector2d post = any_of(field.goal_posts(), random);
      // A half looks at the back end of the goal's frame.
      const double back = random.uniform() < 0.5 ? 0 : file.goals->depth;
      return post + Eigen::Vector2d(std::copysign(back, post.x()), 0);
    }
    default:
      return {random.uniform(-0.5, 0.5) * size.length, random.uniform(-0.5, 0.5) * size.width};
  }
}

/** A camera of the robot that has a point of the ground in view, m in the world. */
void look_at(RandomScene& scene, const Eigen::Vector2d& target, double nearest, double farthest,
             const FieldDimensions& field, Random& random) {
  double distance = nearest;
  Eigen::Vector2d eye = target;
  for (int i = 0; i < 50; ++i) {
    distance = random.uniform(nearest, farthest);
    eye = target + distance * direction(random.uniform(-M_PI, M_PI));
    if (is_on_carpet(eye, field)) break;
  }
  const double height = random.uniform(0.44, 0.54);
  const double elevation = std::atan2(height, distance);
  const bool is_top =
      elevation < 32 * kDegree || (elevation < 50 * kDegree && random.uniform() < 0.5);
  scene.camera = is_top ? "top" : "bottom";
  const double lower = (is_top ? 0 : 30) * kDegree;
  const double upper = (is_top ? 38 : 62) * kDegree;
  const double pitch = std::clamp(elevation + random.uniform(-17, 17) * kDegree, lower, upper);
  const Eigen::Vector2d way = target - eye;
  const double yaw = std::atan2(way.y(), way.x()) + random.uniform(-24, 24) * kDegree;
  scene.heading_in_world = {eye, yaw + random.uniform(-50, 50) * kDegree};
  scene.pose_camera_in_world.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(2.5 * kDegree * random.normal(), Eigen::Vector3d::UnitX()))
          .matrix();
  scene.pose_camera_in_world.translation() << eye.x(), eye.y(), height;
}

/** Turns the camera so that a border of the image cuts the ball: in most images the lower one, as
 * when the ball lies before the robot's feet. */
void turn_to_border(RandomScene& scene, const CameraModel& camera, const Eigen::Vector2d& ball,
                    double radius, Random& random) {
  const Eigen::Vector3d eye = scene.pose_camera_in_world.translation();
  const Eigen::Vector2d way = ball - eye.head<2>();
  const double elevation = std::atan2(eye.z() - radius, way.norm());
  const double size = std::asin(radius / std::hypot(way.norm(), eye.z() - radius));
  const double beyond = random.uniform(-0.8, 0.3) * size;
  double pitch = elevation - 0.5 * camera.vertical_fov - beyond;
  double yaw = std::atan2(way.y(), way.x()) + random.uniform(-24, 24) * kDegree;
  if (random.uniform() < 0.25) {
    pitch = elevation + random.uniform(-17, 17) * kDegree;
    yaw = std::atan2(way.y(), way.x()) + (random.uniform() < 0.5 ? -1 : 1) *
                                             (0.5 * camera.horizontal_fov + beyond) /
                                             std::cos(pitch);
  }
  scene.camera = pitch < 25 * kDegree ? "top" : "bottom";
  scene.pose_camera_in_world.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()))
                                            .matrix();
}

/** A point beyond a place, seen from the camera: up to a distance behind it and beside it, m. */
Eigen::Vector2d behind(const RandomScene& scene, const Eigen::Vector2d& place, double nearest,
                       double farthest, Random& random) {
  const Eigen::Vector2d way = place - scene.pose_camera_in_world.translation().head<2>();
  const double angle = std::atan2(way.y(), way.x()) + random.uniform(-70, 70) * kDegree;
  return place + random.uniform(nearest, farthest) * direction(angle);
}

void add_robot(RandomScene& scene, const RobotModel& model, const Eigen::Vector2d& place,
               Random& random) {
  const bool is_free =
      std::all_of(scene.robots.begin(), scene.robots.end(),
                  [&](const PlacedRobot& other) { return (other.place - place).norm() > 0.35; });
  if (is_free) scene.robots.push_back(place_robot(model, place, random));
}

Eigen::Vector3f dark_color(Random& random) {
  return random.uniform() < 0.7 ? Eigen::Vector3f(Eigen::Vector3f::Constant(0.015f))
                                : random_color(random, 0.01, 0.3);
}

Eigen::Vector3f light_color(Random& random) {
  return random.uniform() < 0.7 ? Eigen::Vector3f(Eigen::Vector3f::Constant(
                                      static_cast<float>(random.uniform(0.5, 0.9))))
                                : random_color(random, 0.4, 0.9);
}

/** From red by orange to yellow. */
Eigen::Vector3f orange_color(Random& random) {
  const auto strong = static_cast<float>(random.uniform(0.5, 0.9));
  return {strong, static_cast<float>(random.uniform(0.02, 0.8)) * strong,
          static_cast<float>(random.uniform(0.01, 0.12))};
}

/** Posts, cones, flat markers, tapes, robots in shirts and people, of colors as an orange ball's,
 * each at one of some places. */
void add_orange_things(RandomScene& scene, const RobotModel& model,
                       const std::vector<Eigen::Vector2d>& places, Random& random) {
  for (const Eigen::Vector2d& place : places) {
    const Eigen::Vector3f color =
        scene.is_ball_plain && random.uniform() < 0.3 ? scene.ball_hexagons : orange_color(random);
    const double yaw = random.uniform(-M_PI, M_PI);
    Distractor thing;
    thing.color = color;
    switch (random.next() % 6) {
      case 0:
      case 1: {
        // A post, a bottle or a cone of rings.
        thing.kind = Distractor::Kind::kCylinder;
        const double height = std::exp(random.uniform(std::log(0.05), std::log(0.9)));
        const int rings = random.uniform() < 0.5 ? 1 : 5;
        const double width = random.uniform(0.04, 0.2);
        for (int i = 0; i < rings; ++i) {
          const double narrowed = width * (1 - 0.18 * i);
          thing.size = {narrowed, narrowed, height / rings};
          thing.pose_in_world.translation() << place.x(), place.y(), height * (i + 0.5) / rings;
          scene.distractors.push_back(thing);
        }
        break;
      }
      case 2: {
        // A flat marker: half of an ellipsoid.
        thing.kind = Distractor::Kind::kSphere;
        const double width = random.uniform(0.1, 0.25);
        thing.size = {width, width, random.uniform(0.15, 0.5) * width};
        thing.pose_in_world.translation() << place.x(), place.y(), 0;
        scene.distractors.push_back(thing);
        break;
      }
      case 3:
        add_box(scene, {place.x(), place.y(), 0.003}, yaw,
                {random.uniform(0.05, 2), random.uniform(0.03, 0.1), 0.004}, color);
        break;
      case 4: {
        const size_t count = scene.robots.size();
        add_robot(scene, model, place, random);
        if (scene.robots.size() > count) scene.robots.back().tint = color;
        break;
      }
      default: {
        const size_t first = scene.distractors.size();
        add_person(scene, place, random);
        // The body, or also shoes and trousers.
        scene.distractors.back().color = color;
        for (size_t i = first; i < scene.distractors.size(); ++i) {
          if (random.uniform() < 0.4) scene.distractors[i].color = color;
        }
      }
    }
  }
}

/** A ball as toys and other leagues have them: orange, yellow, red, pink or blue, a half with dark
 * faces. The rules of 2026 name no color. */
void color_ball(RandomScene& scene, Random& random) {
  scene.is_ball_plain = random.uniform() < 0.5;
  const auto strong = static_cast<float>(random.uniform(0.5, 0.9));
  const auto middle = static_cast<float>(random.uniform(0.02, 0.8));
  const auto weak = static_cast<float>(random.uniform(0.01, 0.12));
  const double hue = random.uniform();
  // From red by orange to yellow; pink; blue.
  scene.ball_hexagons = Eigen::Vector3f(strong, middle * strong, weak);
  if (hue > 0.7) scene.ball_hexagons = Eigen::Vector3f(strong, weak, middle * strong);
  if (hue > 0.85) scene.ball_hexagons = Eigen::Vector3f(weak, middle * strong, strong);
}

/** A board with dark squares, or dots, on a light ground. @param cell  m. */
void add_board(RandomScene& scene, const Eigen::Isometry3d& board, int columns, int rows,
               double cell, Random& random) {
  const double margin = random.uniform(0, 1.5) * cell;
  Distractor ground;
  ground.pose_in_world = board;
  ground.size = {columns * cell + margin, rows * cell + margin, 0.006};
  ground.color = light_color(random);
  scene.distractors.push_back(ground);
  const bool has_dots = random.uniform() < 0.2;
  Distractor square;
  square.kind = has_dots ? Distractor::Kind::kCylinder : Distractor::Kind::kBox;
  const double width = (has_dots ? random.uniform(0.4, 0.9) : 1) * cell;
  square.size = {width, width, 0.012};
  square.color = dark_color(random);
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      if (!has_dots && (row + column) % 2 == 1) continue;
      square.pose_in_world = board * Eigen::Translation3d((column - 0.5 * (columns - 1)) * cell,
                                                          (row - 0.5 * (rows - 1)) * cell, 0);
      scene.distractors.push_back(square);
    }
  }
}

/** A checkerboard: a half lies on the floor, others stand or are held. */
void add_checkerboard(RandomScene& scene, const Eigen::Vector2d& place, Random& random) {
  const int columns = 3 + static_cast<int>(random.uniform(0, 9));
  const int rows = 3 + static_cast<int>(random.uniform(0, 6));
  const double cell = std::exp(random.uniform(std::log(0.02), std::log(0.18)));
  Eigen::Isometry3d board = Eigen::Isometry3d::Identity();
  double tilt = 0;
  double height = 0.004;
  if (random.uniform() < 0.5) {
    tilt = random.uniform(20, 90) * kDegree;
    height =
        0.5 * rows * cell * std::sin(tilt) + (random.uniform() < 0.5 ? 0 : random.uniform(0, 0.9));
  }
  board.translation() << place.x(), place.y(), height;
  board.linear() = (Eigen::AngleAxisd(random.uniform(-M_PI, M_PI), Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()))
                       .matrix();
  add_board(scene, board, columns, rows, cell, random);
}

/** A board of a few large squares that stands on the floor and faces the camera. */
void add_upright_board(RandomScene& scene, const Eigen::Vector2d& place, Random& random) {
  const int columns = 3 + static_cast<int>(random.uniform(0, 3));
  const int rows = 3 + static_cast<int>(random.uniform(0, 2));
  const double cell = random.uniform(0.07, 0.18);
  const Eigen::Vector2d way = place - scene.pose_camera_in_world.translation().head<2>();
  const double yaw = std::atan2(way.y(), way.x()) + random.uniform(-35, 35) * kDegree + M_PI / 2;
  Eigen::Isometry3d board = Eigen::Isometry3d::Identity();
  board.translation() << place.x(), place.y(), 0.5 * rows * cell + 0.02;
  board.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()))
                       .matrix();
  add_board(scene, board, columns, rows, cell, random);
}

/** A person with stripes on shirt and stockings and light soles below dark shoes, or the reverse.
 */
void add_striped_person(RandomScene& scene, const Eigen::Vector2d& place, Random& random) {
  const double yaw = random.uniform(-M_PI, M_PI);
  const std::array<Eigen::Vector3f, 2> colors = {dark_color(random), light_color(random)};
  const double stripe = random.uniform(0.03, 0.12);
  const Eigen::Vector2d side(-std::sin(yaw), std::cos(yaw));
  const bool has_dark_shoes = random.uniform() < 0.5;
  for (const double sign : {-1.0, 1.0}) {
    const Eigen::Vector2d foot = place + sign * random.uniform(0.08, 0.15) * side;
    int number = 0;
    for (double z = 0.05; z < 0.9; z += stripe) {
      Distractor ring;
      ring.kind = Distractor::Kind::kCylinder;
      ring.pose_in_world.translation() << foot.x(), foot.y(), z + 0.5 * stripe;
      ring.size = {0.13, 0.13, stripe};
      ring.color = colors[z < 0.45 ? number++ % 2 : 0];
      scene.distractors.push_back(ring);
    }
    const Eigen::Vector2d toe = foot + 0.06 * direction(yaw);
    add_box(scene, {toe.x(), toe.y(), 0.015}, yaw, {0.29, 0.11, 0.03}, colors[has_dark_shoes]);
    add_box(scene, {toe.x(), toe.y(), 0.055}, yaw, {0.28, 0.1, 0.05}, colors[!has_dark_shoes]);
    const Eigen::Vector2d tip = foot + 0.14 * direction(yaw);
    add_box(scene, {tip.x(), tip.y(), 0.05}, yaw, {0.08, 0.104, 0.05}, colors[has_dark_shoes]);
  }
  const bool is_upright = random.uniform() < 0.5;
  int number = 0;
  if (is_upright) {
    for (double y = -0.22; y < 0.22; y += stripe) {
      const Eigen::Vector2d middle = place + (y + 0.5 * stripe) * side;
      add_box(scene, {middle.x(), middle.y(), 1.2}, yaw, {0.25, stripe, 0.6}, colors[number++ % 2]);
    }
  } else {
    for (double z = 0.9; z < 1.5; z += stripe) {
      add_box(scene, {place.x(), place.y(), z + 0.5 * stripe}, yaw, {0.25, 0.45, stripe},
              colors[number++ % 2]);
    }
  }
}

}  // namespace

const std::vector<std::string>& scene_kind_names() {
  static const std::vector<std::string> names = {
      "mixed",         "ball-on-line",  "ball-on-mark",     "ball-at-shoe",      "ball-at-post",
      "ball-at-robot", "ball-in-glare", "ball-overexposed", "ball-underexposed", "ball-at-border",
      "checkerboard",  "stripes",       "goal-foot",        "crossing",          "robot-feet",
      "ball-colored",  "ball-orange",   "orange-things",    "board-upright"};
  return names;
}

bool has_ball(SceneKind kind) {
  return kind < SceneKind::kCheckerboard || kind == SceneKind::kBallColored ||
         kind == SceneKind::kBallOrange;
}

void add_hard_objects(RandomScene& scene, const RobotModel& model, const SceneFile& file,
                      SceneKind kind, Random& random) {
  const FieldDimensions& field = *file.field;
  const Eigen::Vector2d target = draw_target(file, kind, random);
  const bool is_large = kind == SceneKind::kStripes || kind == SceneKind::kBoardUpright;
  const bool is_at_border = kind == SceneKind::kBallAtBorder;
  look_at(scene, target,
          is_large       ? 0.8
          : is_at_border ? 0.2
                         : 0.35,
          is_at_border ? 1.5 : 4.5, field, random);
  if (has_ball(kind)) place_ball(scene, target, file.ball->radius, random);
  if (kind == SceneKind::kBallColored) color_ball(scene, random);
  if (kind == SceneKind::kBallOrange) {
    scene.is_ball_plain = true;
    scene.ball_hexagons = orange_color(random);
  }
  if (is_at_border)
    turn_to_border(scene, model.cameras().front(), target, file.ball->radius, random);
  switch (kind) {
    case SceneKind::kBallAtShoe:
      if (random.uniform() < 0.5) {
        add_person(scene, behind(scene, target, 0.22, 0.45, random), random);
      } else {
        add_striped_person(scene, behind(scene, target, 0.22, 0.45, random), random);
      }
      break;
    case SceneKind::kBallOnLine:
    case SceneKind::kBallAtRobot: {
      const bool is_line = kind == SceneKind::kBallOnLine;
      const int count = is_line ? static_cast<int>(random.uniform(0, 3)) : 2;
      for (int i = 0; i < count; ++i) {
        add_robot(scene, model, behind(scene, target, 0.18, is_line || i > 0 ? 1.5 : 0.3, random),
                  random);
      }
      break;
    }
    case SceneKind::kCheckerboard:
      add_checkerboard(scene, target, random);
      break;
    case SceneKind::kBoardUpright:
      add_upright_board(scene, target, random);
      break;
    case SceneKind::kStripes:
      add_striped_person(scene, target, random);
      break;
    case SceneKind::kBallOrange:
    case SceneKind::kOrangeThings: {
      std::vector<Eigen::Vector2d> places;
      const double nearest = has_ball(kind) ? 0.3 : 0;
      const int count = static_cast<int>(random.uniform(has_ball(kind) ? 0 : 2, 5));
      for (int i = 0; i < count; ++i) {
        places.push_back(behind(scene, target, nearest, i > 0 ? 1.5 : nearest + 0.3, random));
      }
      add_orange_things(scene, model, places, random);
      break;
    }
    case SceneKind::kRobotFeet:
      add_robot(scene, model, target, random);
      for (int i = 0; i < 2; ++i) {
        add_robot(scene, model, behind(scene, target, 0.35, 1.5, random), random);
      }
      break;
    default:
      if (random.uniform() < 0.3) {
        add_robot(scene, model, behind(scene, target, 0.5, 2, random), random);
      }
  }
}

void vary_exposure(RandomScene& scene, SceneKind kind, Random& random) {
  ImageEffects& effects = scene.effects;
  const bool has_glare =
      kind == SceneKind::kBallInGlare || kind == SceneKind::kGoalFoot || random.uniform() < 0.1;
  if (has_glare) {
    // A half comes from above, as from a window, a half is anywhere.
    const bool is_above = random.uniform() < 0.5;
    effects.glare_center = {random.uniform(0, 640),
                            is_above ? random.uniform(-100, 100) : random.uniform(100, 400)};
    effects.glare_size = {random.uniform(80, is_above ? 900 : 300), random.uniform(60, 260)};
    effects.glare = random.uniform(50, 200);
  }
  if (random.uniform() < 0.5) effects.sharpening = random.uniform(0, 1.8);
  double exposure = 1;
  if (kind == SceneKind::kBallOverexposed) exposure = random.uniform(1.3, 2.1);
  if (kind == SceneKind::kBallUnderexposed) exposure = random.uniform(0.15, 0.45);
  for (double& factor : effects.gain) factor *= exposure;
}

}  // namespace nao::vision
