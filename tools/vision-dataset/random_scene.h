#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "common/random.h"
#include "daemons/head-camera/distortion.h"
#include "kinematics/pose2.h"
#include "rendering/scene_appearance.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"
#include "tools/vision-dataset/image_effects.h"

namespace nao::vision {

/** Another robot in the image. */
struct PlacedRobot {
  Eigen::Isometry3d pose_torso_in_world = Eigen::Isometry3d::Identity();
  /** rad, motor order. */
  std::vector<double> position;
  /** Ground below the torso, m. */
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  /** Factors on its red, green and blue. */
  Eigen::Vector3f tint = Eigen::Vector3f::Ones();
};

/** A box, cylinder or sphere that is neither ball nor robot: banner, leg of a person, shoe. */
struct Distractor {
  enum class Kind { kBox, kCylinder, kSphere };
  Kind kind = Kind::kBox;
  Eigen::Isometry3d pose_in_world = Eigen::Isometry3d::Identity();
  /** Full sizes, m. */
  Eigen::Vector3d size = Eigen::Vector3d::Ones();
  /** Linear red, green, blue. */
  Eigen::Vector3f color = Eigen::Vector3f::Ones();
};

/** Everything that one image of the dataset shows, and how the camera shows it. */
struct RandomScene {
  std::string camera;
  Eigen::Isometry3d pose_camera_in_world = Eigen::Isometry3d::Identity();
  /** Heading frame of the robot that carries the camera. */
  Pose2 heading_in_world;
  camera::Distortion distortion;
  SceneAppearance appearance;
  std::optional<Eigen::Isometry3d> pose_ball_in_world;
  /** Whether the ball has one color, that of its hexagons; otherwise as in SceneBall. */
  bool is_ball_plain = false;
  Eigen::Vector3f ball_hexagons = Eigen::Vector3f::Constant(0.86f);
  float ball_pentagons = 0.012f;
  std::vector<PlacedRobot> robots;
  std::vector<Distractor> distractors;
  ImageEffects effects;
};

/** What a scene shows. All but the first have one thing that is hard to tell: a ball that is hard
 * to see, or an object that looks like one and no ball. */
enum class SceneKind {
  kMixed,
  kBallOnLine,
  kBallOnMark,
  kBallAtShoe,
  kBallAtPost,
  kBallAtRobot,
  kBallInGlare,
  kBallOverexposed,
  kBallUnderexposed,
  kBallAtBorder,
  kCheckerboard,
  kStripes,
  kGoalFoot,
  kCrossing,
  kRobotFeet,
  kBallColored,
  kBallOrange,
  kOrangeThings,
  kBoardUpright
};
/** Names of the kinds, in their order: ball-on-line. */
const std::vector<std::string>& scene_kind_names();
/** The scenes of this kind have a ball; kMixed has one in some of them. */
bool has_ball(SceneKind kind);

/** Ranges of the random scenes. The fractions hold for kMixed. */
struct SceneOptions {
  /** Images that have a ball, 0 to 1. */
  double ball_fraction = 0.8;
  /** Other robots within 5 m, at most 3. */
  int most_robots = 3;
  SceneKind kind = SceneKind::kMixed;
};

/** Draws a scene: light, carpet, wear and surroundings from the place's number, the rest from the
 * image's number.
 *
 * The ranges are chosen so that images look like those of real matches: pale to dark carpets,
 * halls and windows with hard shadows, blur while walking, poor white balance. */
RandomScene make_scene(const RobotModel& model, const SceneFile& field, const SceneOptions& options,
                       uint64_t place, uint64_t image);

}  // namespace nao::vision
