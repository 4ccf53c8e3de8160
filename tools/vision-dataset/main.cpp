// Writes rendered images of a soccer field with exact labels.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "common/command_line.h"
#include "common/error.h"
#include "common/output_file.h"
#include "common/program.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"
#include "tools/vision-dataset/dataset_renderer.h"

namespace {

struct DatasetOptions {
  std::string folder;
  std::string model = "nao";
  int num_images = 100;
  uint64_t seed = 1;
  int num_places = 20;
  uint64_t first_place = 0;
  nao::vision::SceneOptions scene;
  std::vector<std::string> kinds = {"mixed"};
};

std::vector<nao::vision::SceneKind> read_kinds(const std::vector<std::string>& names) {
  const std::vector<std::string>& all = nao::vision::scene_kind_names();
  std::vector<nao::vision::SceneKind> kinds;
  for (const std::string& name : names) {
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end()) {
      throw nao::ConfigError(
          fmt::format("no kind of scene '{}'; there are: {}", name, fmt::join(all, ", ")));
    }
    kinds.push_back(static_cast<nao::vision::SceneKind>(found - all.begin()));
  }
  return kinds;
}

void write_dataset(const DatasetOptions& options) {
  const auto model = nao::RobotModel::find(options.model);
  const nao::SceneFile field = nao::SceneFile::find("soccer");
  std::filesystem::create_directories(options.folder);
  nao::vision::DatasetRenderer renderer(model, field);
  const std::vector<nao::vision::SceneKind> kinds = read_kinds(options.kinds);
  std::vector<nao::vision::LabelledImage> images;
  for (int i = 0; i < options.num_images; ++i) {
    const uint64_t place = options.first_place + static_cast<uint64_t>(i % options.num_places);
    // The kinds alternate, in another order at each visit of a place.
    nao::vision::SceneOptions scene_options = options.scene;
    const size_t number = static_cast<size_t>(i) + static_cast<size_t>(i / options.num_places);
    scene_options.kind = kinds[number % kinds.size()];
    const auto scene = nao::vision::make_scene(model, field, scene_options, place,
                                               1000000 * options.seed + static_cast<uint64_t>(i));
    nao::vision::LabelledImage& image = images.emplace_back();
    image.file = std::filesystem::path(options.folder) / fmt::format("{:06}.jpg", i);
    image.place = fmt::format("place-{}", place);
    const cv::Mat bgr = renderer.render(scene, image);
    std::vector<uint8_t> jpeg;
    cv::imencode(".jpg", bgr, jpeg, {cv::IMWRITE_JPEG_QUALITY, scene.effects.quality});
    nao::replace_file(image.file, {jpeg.begin(), jpeg.end()});
  }
  nao::vision::write_labels(options.folder, images);
  fmt::print("{} images and {} in {}\n", images.size(), nao::vision::kLabelFile, options.folder);
}

}  // namespace

int main(int argc, char** argv) {
  nao::CommandLine app("Writes rendered images of a soccer field with exact labels",
                       "nao-vision-dataset");
  nao::CommonOptions common;
  DatasetOptions options;
  app.add_version_flag("--version", nao::version());
  app.add_option("folder", options.folder, "Where to write the images and labels.json (COCO)")
      ->required();
  app.add_option("--images", options.num_images, "Number of images")->range(1, 1000000);
  app.add_option("--seed", options.seed, "Equal seeds give equal images");
  app.add_option("--places", options.num_places,
                 "Number of places: light, carpet, surroundings and camera differ between them")
      ->range(1, 100000);
  app.add_option("--first-place", options.first_place, "Number of the first place");
  app.add_option("--balls", options.scene.ball_fraction, "Fraction of images with a ball")
      ->range(0.0, 1.0);
  app.add_option("--robots", options.scene.most_robots,
                 "Greatest number of other robots in an image")
      ->range(0, 3);
  app.add_option("--kinds", options.kinds,
                 "Kinds of scenes, which alternate: " +
                     fmt::format("{}", fmt::join(nao::vision::scene_kind_names(), ", ")))
      ->separated_by(',');
  app.add_option("--model", options.model, "Folder of robots/ that describes the robots");
  return nao::run_program(app, common, argc, argv, [&] { write_dataset(options); });
}
