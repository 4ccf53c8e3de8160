// Runs perception on the images of a folder, scores it where labels exist, and writes detections as
// JSON and as drawn images.

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "common/command_line.h"
#include "common/error.h"
#include "common/json_writer.h"
#include "common/output_file.h"
#include "common/processor_time.h"
#include "common/program.h"
#include "daemons/vision/drawing.h"
#include "daemons/vision/vision_core.h"
#include "tools/vision-eval/image_labels.h"
#include "tools/vision-eval/scores.h"

namespace {

using nao::vision::Detection;
using nao::vision::LabelledImage;
using nao::vision::VisionCore;
using nao::vision::VisionInput;
using nao::vision::VisionResult;

struct EvalOptions {
  std::string folder;
  std::string json_file;
  std::string drawing_folder;
  bool ignores_pose = false;
};

/** Processor time of each stage. */
class StageTimes {
 public:
  void start() { last_ = begin_ = 1e3 * nao::thread_seconds(); }
  void finish(const std::string& stage) {
    const double now = 1e3 * nao::thread_seconds();
    if (times_.count(stage) == 0) order_.push_back(stage);
    times_[stage].push_back(now - last_);
    last_ = now;
  }
  void finish_image() {
    last_ = begin_;
    finish("all stages");
  }
  void print() const {
    fmt::print("{:14} {:>10} {:>10}\n", "stage", "median ms", "p95 ms");
    for (const std::string& stage : order_) {
      std::vector<double> times = times_.at(stage);
      std::sort(times.begin(), times.end());
      fmt::print("{:14} {:10.2f} {:10.2f}\n", stage, times[times.size() / 2],
                 times[times.size() * 95 / 100]);
    }
  }

 private:
  std::map<std::string, std::vector<double>> times_;
  std::vector<std::string> order_;
  double begin_ = 0;
  double last_ = 0;
};

void write_json(const LabelledImage& image, const VisionResult& result, nao::JsonWriter& json) {
  json.begin_object();
  json.add("file_name", image.file.filename().string());
  json.add("image_status", nao::vision::image_status_name(result.image_status));
  json.begin_array("detections");
  for (const Detection& d : result.detections) {
    json.begin_object();
    json.add("kind", nao::vision::kind_name(d.kind));
    json.add("box_px", d.box_px.data(), 4);
    if (d.line_px.allFinite()) json.add("line_px", d.line_px.data(), 4);
    if (d.has_position()) {
      json.add("position_in_heading", d.position.data(), 2);
      json.add("covariance", d.covariance.data(), 4);
    }
    if (d.end.allFinite()) json.add("end_in_heading", d.end.data(), 2);
    json.add("confidence", d.confidence);
    json.end();
  }
  json.end();
  json.end();
}

int evaluate(const EvalOptions& options) {
  const std::vector<LabelledImage> images = nao::vision::read_images(options.folder);
  if (images.empty()) throw nao::Error(options.folder + " has no JPEG or PNG images");
  if (!options.drawing_folder.empty()) {
    std::filesystem::create_directories(options.drawing_folder);
  }
  nao::vision::configure_process();
  const auto networks = nao::vision::VisionNetworks::load();
  StageTimes times;
  nao::vision::Scores scores;
  nao::JsonWriter json;
  json.begin_array();
  int num_unreadable = 0;
  bool has_labels = false;
  for (const LabelledImage& image : images) {
    VisionInput input;
    input.bgr = cv::imread(image.file.string(), cv::IMREAD_COLOR);
    if (input.bgr.empty()) {
      fmt::print(stderr, "cannot read {}\n", image.file.string());
      ++num_unreadable;
      continue;
    }
    input.calibration = image.calibration.value_or(
        nao::vision::CameraCalibration::guess(input.bgr.cols, input.bgr.rows));
    if (!options.ignores_pose) input.pose_camera_in_heading = image.pose_camera_in_heading;
    VisionCore core(networks);
    core.on_stage([&times](const char* stage) { times.finish(stage); });
    times.start();
    const VisionResult result = core.process(input);
    times.finish_image();
    scores.add(image, result.detections);
    has_labels |= image.labels.has_value();
    write_json(image, result, json);
    if (!options.drawing_folder.empty()) {
      nao::vision::draw_result(result, input.bgr);
      const auto file = std::filesystem::path(options.drawing_folder) / image.file.stem();
      std::vector<uint8_t> png;
      cv::imencode(".png", input.bgr, png);
      nao::replace_file(file.string() + ".png", {png.begin(), png.end()});
    }
  }
  if (!options.json_file.empty()) nao::replace_file(options.json_file, json.take() + "\n");
  fmt::print("{} images of {}\n\n", images.size() - num_unreadable, options.folder);
  if (has_labels) fmt::print("{}\n", scores.table());
  times.print();
  return num_unreadable > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  nao::CommandLine app("Runs perception on images, and scores it where labels exist",
                       "nao-vision-eval");
  nao::CommonOptions common;
  EvalOptions options;
  app.add_version_flag("--version", nao::version());
  app.add_option("folder", options.folder,
                 "Images, JPEG or PNG; with labels.json of nao-vision-dataset they are scored")
      ->required();
  app.add_option("--json", options.json_file, "Write the detections to this file");
  app.add_option("--draw", options.drawing_folder, "Write the images with the detections here");
  app.add_flag("--no-pose", options.ignores_pose, "Ignore the camera's pose of labels.json");
  return nao::run_program_with_status(app, common, argc, argv, [&] { return evaluate(options); });
}
