#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"

namespace nao::vision {

/** A labelled object: as a Detection, with the fraction of it that is visible, 0 to 1. */
struct Label {
  Detection object;
  double visible = 1;
};

/** An image file with its camera and labels. */
struct LabelledImage {
  std::filesystem::path file;
  int width = 0;
  int height = 0;
  /** Group of images that were varied together, such as "place-3"; empty if unknown. */
  std::string place;
  std::optional<CameraCalibration> calibration;
  std::optional<Eigen::Isometry3d> pose_camera_in_heading;
  /** Nothing: the image is not labelled. */
  std::optional<std::vector<Label>> labels;
};

/** Name of the file with the labels of a folder: COCO JSON, docs/vision.md. */
inline constexpr const char* kLabelFile = "labels.json";

/** Images of a folder: those of its label file, or else all JPEG and PNG files, without labels.
 * @throws Error  if the folder or its label file cannot be read. */
std::vector<LabelledImage> read_images(const std::filesystem::path& folder);

/** Writes the label file of a folder. @throws Error  if it cannot be written. */
void write_labels(const std::filesystem::path& folder, const std::vector<LabelledImage>& images);

}  // namespace nao::vision
