#include "tools/vision-eval/image_labels.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "common/error.h"
#include "common/output_file.h"

namespace nao::vision {
namespace {

using Json = nlohmann::ordered_json;

// NaN becomes null in JSON, and null NaN again in vector().
Json numbers(const Eigen::VectorXd& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(value);
  return list;
}

template <int size>
Eigen::Matrix<double, size, 1> vector(const Json& list) {
  Eigen::Matrix<double, size, 1> values;
  for (int i = 0; i < size; ++i) {
    const Json& value = list.at(i);
    values[i] = value.is_null() ? kUnknown : value.get<double>();
  }
  return values;
}

Json camera_json(const LabelledImage& image) {
  Json json;
  if (image.calibration) {
    const CameraCalibration& c = *image.calibration;
    json["fx"] = c.fx;
    json["fy"] = c.fy;
    json["cx"] = c.cx;
    json["cy"] = c.cy;
    json["distortion"] = c.distortion;
  }
  if (image.pose_camera_in_heading) {
    const Eigen::Quaterniond q(image.pose_camera_in_heading->linear());
    json["position_in_heading"] = numbers(image.pose_camera_in_heading->translation());
    json["orientation_in_heading"] = {q.w(), q.x(), q.y(), q.z()};
  }
  return json;
}

void read_camera(const Json& json, LabelledImage& image) {
  if (json.contains("fx")) {
    CameraCalibration c;
    c.fx = json.at("fx");
    c.fy = json.at("fy");
    c.cx = json.at("cx");
    c.cy = json.at("cy");
    c.distortion = json.at("distortion").get<std::array<double, 5>>();
    if (!c.is_valid()) throw Error("the camera of " + image.file.string() + " is not valid");
    image.calibration = c;
  }
  if (json.contains("position_in_heading")) {
    const Eigen::Vector4d q = vector<4>(json.at("orientation_in_heading"));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    pose.translation() = vector<3>(json.at("position_in_heading"));
    image.pose_camera_in_heading = pose;
  }
}

// COCO's format of annotations (bounding box as x, y, width, height), with further keys for
// positions on the ground.
Label read_label(const Json& json) {
  Label label;
  const int category = json.at("category_id");
  if (category < 1 || category > kNumKinds) {
    throw Error("category_id " + std::to_string(category) + " is outside 1 to " +
                std::to_string(kNumKinds));
  }
  label.object.kind = static_cast<Kind>(category - 1);
  const Eigen::Vector4d box = vector<4>(json.at("bbox"));
  label.object.box_px = {box[0], box[1], box[0] + box[2], box[1] + box[3]};
  if (json.contains("line")) label.object.line_px = vector<4>(json.at("line"));
  if (json.contains("position")) label.object.position = vector<2>(json.at("position"));
  if (json.contains("end")) label.object.end = vector<2>(json.at("end"));
  label.visible = json.value("visible", 1.0);
  return label;
}

std::vector<LabelledImage> read_label_file(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<LabelledImage> images;
  try {
    const Json json = Json::parse(stream);
    std::map<int64_t, size_t> index;
    for (const Json& entry : json.at("images")) {
      LabelledImage image;
      image.file = file.parent_path() / entry.at("file_name").get<std::string>();
      image.width = entry.at("width");
      image.height = entry.at("height");
      image.place = entry.value("place", "");
      if (entry.contains("camera")) read_camera(entry.at("camera"), image);
      image.labels.emplace();
      index[entry.at("id")] = images.size();
      images.push_back(std::move(image));
    }
    // Annotations refer to images by id, not by order.
    for (const Json& entry : json.at("annotations")) {
      images.at(index.at(entry.at("image_id"))).labels->push_back(read_label(entry));
    }
  } catch (const std::exception& error) {
    throw Error(file.string() + ": " + error.what());
  }
  return images;
}

}  // namespace

std::vector<LabelledImage> read_images(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw Error("there is no folder " + folder.string());
  }
  if (std::filesystem::exists(folder / kLabelFile)) return read_label_file(folder / kLabelFile);
  // Without labels: all images of the folder, in the order of their names.
  std::vector<LabelledImage> images;
  const std::set<std::string> suffixes = {".jpg", ".jpeg", ".png", ".JPG", ".PNG"};
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (suffixes.count(entry.path().extension().string()) == 0) continue;
    images.emplace_back().file = entry.path();
  }
  std::sort(images.begin(), images.end(),
            [](const LabelledImage& a, const LabelledImage& b) { return a.file < b.file; });
  return images;
}

void write_labels(const std::filesystem::path& folder, const std::vector<LabelledImage>& images) {
  Json json;
  json["images"] = Json::array();
  json["annotations"] = Json::array();
  json["categories"] = Json::array();
  for (int kind = 0; kind < kNumKinds; ++kind) {
    json["categories"].push_back({{"id", kind + 1}, {"name", kind_name(static_cast<Kind>(kind))}});
  }
  for (size_t i = 0; i < images.size(); ++i) {
    const LabelledImage& image = images[i];
    json["images"].push_back({{"id", i + 1},
                              {"file_name", image.file.filename().string()},
                              {"width", image.width},
                              {"height", image.height},
                              {"place", image.place},
                              {"camera", camera_json(image)}});
    for (const Label& label : image.labels.value_or(std::vector<Label>{})) {
      const Detection& d = label.object;
      const Eigen::Vector4d box(d.box_px[0], d.box_px[1], d.box_px[2] - d.box_px[0],
                                d.box_px[3] - d.box_px[1]);
      Json entry = {{"id", json["annotations"].size() + 1},
                    {"image_id", i + 1},
                    {"category_id", static_cast<int>(d.kind) + 1},
                    {"bbox", numbers(box)},
                    {"area", box[2] * box[3]},
                    {"iscrowd", 0},
                    {"visible", label.visible}};
      if (d.line_px.allFinite()) entry["line"] = numbers(d.line_px);
      if (d.has_position()) entry["position"] = numbers(d.position);
      if (d.end.allFinite()) entry["end"] = numbers(d.end);
      json["annotations"].push_back(std::move(entry));
    }
  }
  replace_file(folder / kLabelFile, json.dump(1) + "\n");
}

}  // namespace nao::vision
