// Cuts patches out of the images of nao-vision-dataset, from which train.py trains the networks.

#include <fmt/core.h>

#include <opencv2/imgcodecs.hpp>

#include "common/command_line.h"
#include "common/error.h"
#include "common/program.h"
#include "tools/vision-train/ball_patches.h"

namespace {

using nao::vision::NeuralNetwork;

struct PatchOptions {
  std::string folder;
  std::string file;
  std::string objects;
  std::string ball;
  bool is_colored = false;
};

void cut_patches(const PatchOptions& options) {
  const auto images = nao::vision::read_images(options.folder);
  nao::vision::PatchFile file(options.file);
  const auto objects =
      std::make_shared<NeuralNetwork>(options.objects, nao::vision::ObjectDetector::shape());
  std::shared_ptr<NeuralNetwork> ball;
  if (!options.ball.empty()) {
    ball = std::make_shared<NeuralNetwork>(options.ball, nao::vision::BallDetector::shape());
  }
  nao::vision::BallPatches patches(file, objects, ball, options.is_colored, 1);
  for (const nao::vision::LabelledImage& image : images) {
    const cv::Mat bgr = cv::imread(image.file.string(), cv::IMREAD_COLOR);
    if (bgr.empty() || !image.labels || !image.calibration) {
      throw nao::Error(image.file.string() + " cannot be read or has no labels");
    }
    patches.add(image, bgr);
  }
  file.close();
  const auto& recall = patches.recall();
  fmt::print("{} patches of {} images in {}; places of balls: {:.1f} in an image\n",
             file.num_records(), images.size(), options.file,
             static_cast<double>(recall.num_places) / recall.num_images);
  const std::array<const char*, 2> ranges = {"to 3 m", "3 to 5 m"};
  for (size_t i = 0; i < ranges.size(); ++i) {
    fmt::print("  balls {}: {} of {} are among them\n", ranges[i], recall.num_found[i],
               recall.num_balls[i]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  nao::CommandLine app("Cuts patches out of labelled images to train the networks of nao-vision",
                       "nao-vision-patches");
  nao::CommonOptions common;
  PatchOptions options;
  app.add_version_flag("--version", nao::version());
  app.add_option("folder", options.folder, "Images and labels.json of nao-vision-dataset")
      ->required();
  app.add_option("file", options.file, "Where to write the patches")->required();
  app.add_option("--objects", options.objects, "objects.onnx: the places that it finds are judged")
      ->required();
  app.add_option("--ball", options.ball,
                 "ball.onnx; adds the patches that this network judges a second time");
  app.add_flag(
      "--colored", options.is_colored,
      "Only patches of the color of a ball of one color, for the network that judges those");
  return nao::run_program(app, common, argc, argv, [&] { cut_patches(options); });
}
