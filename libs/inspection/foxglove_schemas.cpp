#include "inspection/foxglove_schemas.h"

#include <map>
#include <utility>
#include <vector>

#include "common/json_writer.h"

namespace nao {
namespace {

/** A JSON Schema as text. */
using Schema = std::string;
using Properties = std::vector<std::pair<std::string, Schema>>;

Schema simple(const char* type) {
  return std::string(R"({"type":")") + type + "\"}";
}

Schema number() {
  return simple("number");
}
Schema text() {
  return simple("string");
}
Schema boolean() {
  return simple("boolean");
}
Schema integer() {
  return simple("integer");
}

Schema list(const Schema& items) {
  return R"({"type":"array","items":)" + items + "}";
}

/** An object. @param optional  Further properties, which may be absent. */
Schema object(const std::string& title, const Properties& required,
              const Properties& optional = {}) {
  JsonWriter json;
  json.begin_object();
  json.add("title", title);
  json.add("type", "object");
  json.begin_object("properties");
  for (const auto& [name, schema] : required) json.add_json(name, schema);
  for (const auto& [name, schema] : optional) json.add_json(name, schema);
  json.end();
  json.begin_array("required");
  for (const auto& [name, schema] : required) json.add("", name);
  return json.take();
}

Schema time_of(const char* title) {
  return object(title, {{"sec", integer()}, {"nsec", integer()}});
}

Schema timestamp() {
  return time_of("time");
}

Schema vector() {
  return object("foxglove.Vector3", {{"x", number()}, {"y", number()}, {"z", number()}});
}

Schema quaternion() {
  return object("foxglove.Quaternion",
                {{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}

Schema pose() {
  return object("foxglove.Pose", {{"position", vector()}, {"orientation", quaternion()}});
}

Schema color() {
  return object("foxglove.Color",
                {{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

Schema frame_transforms() {
  return object(
      kFrameTransformsSchema,
      {{"transforms", list(object("foxglove.FrameTransform", {{"timestamp", timestamp()},
                                                              {"parent_frame_id", text()},
                                                              {"child_frame_id", text()},
                                                              {"translation", vector()},
                                                              {"rotation", quaternion()}}))}});
}

Schema joint_states() {
  return object(
      kJointStatesSchema,
      {{"timestamp", timestamp()},
       {"joints",
        list(object("foxglove.JointState", {{"name", text()}},
                    {{"position", number()}, {"velocity", number()}, {"effort", number()}}))}});
}

Schema odometry() {
  return object(kOdometrySchema,
                {{"timestamp", timestamp()},
                 {"frame_id", text()},
                 {"body_frame_id", text()},
                 {"pose", pose()}},
                {{"linear_velocity", vector()}, {"angular_velocity", vector()}});
}

Schema compressed_image() {
  return object(kCompressedImageSchema,
                {{"timestamp", timestamp()},
                 {"frame_id", text()},
                 {"data", R"({"type":"string","contentEncoding":"base64"})"},
                 {"format", text()}});
}

Schema camera_calibration() {
  return object(kCameraCalibrationSchema, {{"timestamp", timestamp()},
                                           {"frame_id", text()},
                                           {"width", integer()},
                                           {"height", integer()},
                                           {"distortion_model", text()},
                                           {"D", list(number())},
                                           {"K", list(number())},
                                           {"R", list(number())},
                                           {"P", list(number())}});
}

Schema scene_update() {
  const Schema key_value = object("foxglove.KeyValuePair", {{"key", text()}, {"value", text()}});
  const Schema deletion = object("foxglove.SceneEntityDeletion",
                                 {{"timestamp", timestamp()}, {"type", integer()}, {"id", text()}});
  const Schema arrow = object("foxglove.ArrowPrimitive", {{"pose", pose()},
                                                          {"shaft_length", number()},
                                                          {"shaft_diameter", number()},
                                                          {"head_length", number()},
                                                          {"head_diameter", number()},
                                                          {"color", color()}});
  const Schema sphere = object("foxglove.SpherePrimitive",
                               {{"pose", pose()}, {"size", vector()}, {"color", color()}});
  const Schema line = object("foxglove.LinePrimitive", {{"type", integer()},
                                                        {"pose", pose()},
                                                        {"thickness", number()},
                                                        {"scale_invariant", boolean()},
                                                        {"points", list(vector())},
                                                        {"color", color()},
                                                        {"colors", list(color())},
                                                        {"indices", list(integer())}});
  const Schema label = object("foxglove.TextPrimitive", {{"pose", pose()},
                                                         {"billboard", boolean()},
                                                         {"font_size", number()},
                                                         {"scale_invariant", boolean()},
                                                         {"color", color()},
                                                         {"text", text()}});
  // Kinds of primitives that are never used: always an empty list.
  const Schema unused = list(object("unused", {}));
  const Schema entity = object("foxglove.SceneEntity", {{"timestamp", timestamp()},
                                                        {"frame_id", text()},
                                                        {"id", text()},
                                                        {"lifetime", time_of("duration")},
                                                        {"frame_locked", boolean()},
                                                        {"metadata", list(key_value)},
                                                        {"arrows", list(arrow)},
                                                        {"cubes", unused},
                                                        {"spheres", list(sphere)},
                                                        {"cylinders", unused},
                                                        {"lines", list(line)},
                                                        {"triangles", unused},
                                                        {"texts", list(label)},
                                                        {"models", unused}});
  return object(kSceneUpdateSchema, {{"deletions", list(deletion)}, {"entities", list(entity)}});
}

}  // namespace

std::string foxglove_schema(const std::string& name) {
  static const std::map<std::string, Schema (*)()> kSchemas{
      {kCameraCalibrationSchema, camera_calibration},
      {kCompressedImageSchema, compressed_image},
      {kFrameTransformsSchema, frame_transforms},
      {kJointStatesSchema, joint_states},
      {kOdometrySchema, odometry},
      {kSceneUpdateSchema, scene_update}};
  return kSchemas.at(name)();
}

}  // namespace nao
