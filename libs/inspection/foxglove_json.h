#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "common/json_writer.h"

namespace nao {

/** Parts of messages in Foxglove's schemas. Lengths and quaternions are rounded to 10^-6, which no
 * screen resolves, so that the text is half as long. */

/** @param utime  Robot time, microseconds. */
void add_time(JsonWriter& json, const std::string& key, int64_t utime);
/** An object of x, y and z. */
void add_vector(JsonWriter& json, const std::string& key, const Eigen::Vector3d& vector);
void add_quaternion(JsonWriter& json, const std::string& key, const Eigen::Quaterniond& rotation);
void add_pose(JsonWriter& json, const std::string& key, const Eigen::Isometry3d& pose);

/** Pose of one frame in another. */
struct NamedTransform {
  std::string parent;
  std::string child;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

/** A foxglove.FrameTransforms. */
std::string frame_transforms_json(int64_t utime, const std::vector<NamedTransform>& transforms);

/** Red, green, blue, opacity, each 0 to 1. */
struct SceneColor {
  double r = 0;
  double g = 0;
  double b = 0;
  double a = 1;
};

/** One entity of a foxglove.SceneUpdate: what is drawn in one frame under one name. It replaces the
 * entity that had the name before. */
struct SceneEntity {
  struct Sphere {
    Eigen::Vector3d center;
    /** m. */
    double diameter;
    SceneColor color;
  };
  struct Line {
    std::vector<Eigen::Vector3d> points;
    SceneColor color;
    bool is_closed;
  };
  struct Arrow {
    Eigen::Vector3d tail;
    /** Vector from tail to tip, m. */
    Eigen::Vector3d shaft;
    SceneColor color;
  };
  struct Text {
    Eigen::Vector3d position;
    std::string text;
    SceneColor color;
  };

  std::string frame;
  std::string id;
  std::vector<Sphere> spheres;
  std::vector<Line> lines;
  std::vector<Arrow> arrows;
  std::vector<Text> texts;
};

/** A foxglove.SceneUpdate. */
std::string scene_update_json(int64_t utime, const std::vector<SceneEntity>& entities);

}  // namespace nao
