#include "inspection/foxglove_json.h"

#include <algorithm>
#include <cmath>

#include "common/rotation.h"

namespace nao {
namespace {

constexpr int64_t kMicrosecondsPerSecond = 1'000'000;
constexpr int64_t kNanosecondsPerMicrosecond = 1000;

// Constants of foxglove.LinePrimitive.
constexpr int kLineStrip = 0;
constexpr int kLineLoop = 1;
// Chosen to be visible beside a robot of half a metre: m, and pixels for lines of constant width.
constexpr double kLineThickness = 2;
constexpr double kArrowDiameter = 0.006;
constexpr double kArrowHeadDiameter = 0.014;
constexpr double kArrowHeadLength = 0.02;
constexpr double kFontSize = 12;

/** Rounds to 10^-6. Numbers that are not finite, such as NaN of an unknown point, become 0: these
 * schemas have no null. */
void add_number(JsonWriter& json, const char* key, double value) {
  const double steps = std::round(value * 1e6);
  json.add(key, std::isfinite(steps) ? steps / 1e6 : 0.0);
}

void add_color(JsonWriter& json, const SceneColor& color) {
  json.begin_object("color");
  json.add("r", color.r);
  json.add("g", color.g);
  json.add("b", color.b);
  json.add("a", color.a);
  json.end();
}

void add_empty_list(JsonWriter& json, const char* key) {
  json.begin_array(key);
  json.end();
}

void add_sphere(JsonWriter& json, const SceneEntity::Sphere& sphere) {
  json.begin_object();
  add_pose(json, "pose", Eigen::Isometry3d(Eigen::Translation3d(sphere.center)));
  add_vector(json, "size", Eigen::Vector3d::Constant(sphere.diameter));
  add_color(json, sphere.color);
  json.end();
}

void add_line(JsonWriter& json, const SceneEntity::Line& line) {
  json.begin_object();
  json.add("type", line.is_closed ? kLineLoop : kLineStrip);
  add_pose(json, "pose", Eigen::Isometry3d::Identity());
  json.add("thickness", kLineThickness);
  json.add("scale_invariant", true);
  json.begin_array("points");
  for (const Eigen::Vector3d& point : line.points) add_vector(json, "", point);
  json.end();
  add_color(json, line.color);
  add_empty_list(json, "colors");
  add_empty_list(json, "indices");
  json.end();
}

void add_arrow(JsonWriter& json, const SceneEntity::Arrow& arrow) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = arrow.tail;
  const double length = arrow.shaft.norm();
  if (length > 0) {
    pose.linear() = rotation_between(Eigen::Vector3d::UnitX(), arrow.shaft).toRotationMatrix();
  }
  json.begin_object();
  add_pose(json, "pose", pose);
  add_number(json, "shaft_length", std::max(0.0, length - kArrowHeadLength));
  json.add("shaft_diameter", kArrowDiameter);
  json.add("head_length", kArrowHeadLength);
  json.add("head_diameter", kArrowHeadDiameter);
  add_color(json, arrow.color);
  json.end();
}

void add_text(JsonWriter& json, const SceneEntity::Text& text) {
  json.begin_object();
  add_pose(json, "pose", Eigen::Isometry3d(Eigen::Translation3d(text.position)));
  json.add("billboard", true);
  json.add("font_size", kFontSize);
  json.add("scale_invariant", true);
  add_color(json, text.color);
  json.add("text", text.text);
  json.end();
}

template <class Item>
void add_list(JsonWriter& json, const char* key, const std::vector<Item>& items,
              void (*add_item)(JsonWriter&, const Item&)) {
  json.begin_array(key);
  for (const Item& item : items) add_item(json, item);
  json.end();
}

}  // namespace

void add_time(JsonWriter& json, const std::string& key, int64_t utime) {
  utime = std::max<int64_t>(0, utime);
  json.begin_object(key);
  json.add("sec", utime / kMicrosecondsPerSecond);
  json.add("nsec", utime % kMicrosecondsPerSecond * kNanosecondsPerMicrosecond);
  json.end();
}

void add_vector(JsonWriter& json, const std::string& key, const Eigen::Vector3d& vector) {
  json.begin_object(key);
  add_number(json, "x", vector.x());
  add_number(json, "y", vector.y());
  add_number(json, "z", vector.z());
  json.end();
}

void add_quaternion(JsonWriter& json, const std::string& key, const Eigen::Quaterniond& rotation) {
  json.begin_object(key);
  add_number(json, "x", rotation.x());
  add_number(json, "y", rotation.y());
  add_number(json, "z", rotation.z());
  add_number(json, "w", rotation.w());
  json.end();
}

void add_pose(JsonWriter& json, const std::string& key, const Eigen::Isometry3d& pose) {
  json.begin_object(key);
  add_vector(json, "position", pose.translation());
  add_quaternion(json, "orientation", Eigen::Quaterniond(pose.linear()));
  json.end();
}

std::string frame_transforms_json(int64_t utime, const std::vector<NamedTransform>& transforms) {
  JsonWriter json;
  json.begin_object();
  json.begin_array("transforms");
  for (const NamedTransform& transform : transforms) {
    json.begin_object();
    add_time(json, "timestamp", utime);
    json.add("parent_frame_id", transform.parent);
    json.add("child_frame_id", transform.child);
    add_vector(json, "translation", transform.pose.translation());
    add_quaternion(json, "rotation", Eigen::Quaterniond(transform.pose.linear()));
    json.end();
  }
  return json.take();
}

std::string scene_update_json(int64_t utime, const std::vector<SceneEntity>& entities) {
  JsonWriter json;
  json.begin_object();
  add_empty_list(json, "deletions");
  json.begin_array("entities");
  for (const SceneEntity& entity : entities) {
    json.begin_object();
    add_time(json, "timestamp", utime);
    json.add("frame_id", entity.frame);
    json.add("id", entity.id);
    // No lifetime: the entity stays until the next one of its name.
    add_time(json, "lifetime", 0);
    json.add("frame_locked", true);
    add_empty_list(json, "metadata");
    add_list(json, "arrows", entity.arrows, add_arrow);
    add_empty_list(json, "cubes");
    add_list(json, "spheres", entity.spheres, add_sphere);
    add_empty_list(json, "cylinders");
    add_list(json, "lines", entity.lines, add_line);
    add_empty_list(json, "triangles");
    add_list(json, "texts", entity.texts, add_text);
    add_empty_list(json, "models");
    json.end();
  }
  return json.take();
}

}  // namespace nao
