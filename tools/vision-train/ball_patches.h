#pragma once

#include <array>
#include <memory>
#include <opencv2/core.hpp>

#include "common/random.h"
#include "daemons/vision/ball_detector.h"
#include "daemons/vision/object_detector.h"
#include "tools/vision-eval/image_labels.h"
#include "tools/vision-train/patch_file.h"

namespace nao::vision {

/** Patches of balls and of objects that the ball detector might take for one.
 *
 * Numbers of a record: 1 for a ball, 0 for none; the network's three regression targets
 * (BallDetector::kNumOutputs); visible fraction of the ball, 0 to 1; radius of the circle, pixels;
 * number of the image; source (Source). */
class BallPatches {
 public:
  enum class Source { kMoved, kPlace, kRandom, kSecond };

  /** @param objects  Network of ObjectDetector; its places of balls are judged.
   * @param ball  Network of BallDetector; adds the patches that it would judge a second time. May
   * be null.
   * @param is_colored  Only patches that the network of balls of one color judges. */
  BallPatches(PatchFile& file, std::shared_ptr<NeuralNetwork> objects,
              std::shared_ptr<NeuralNetwork> ball, bool is_colored, uint64_t seed);

  void add(const LabelledImage& image, const cv::Mat& bgr);

  /** Visible balls to 3 m and from 3 to 5 m, and how many of them are among the places. */
  struct PlaceRecall {
    std::array<int, 2> num_balls{};
    std::array<int, 2> num_found{};
    int num_places = 0;
    int num_images = 0;
  };
  const PlaceRecall& recall() const { return recall_; }

 private:
  void add_circle(const PatchSampler& sampler, const Circle& circle, Source source);

  PatchFile& file_;
  ObjectDetector objects_;
  std::shared_ptr<NeuralNetwork> ball_network_;
  bool is_colored_;
  Random random_;
  PlaceRecall recall_;
  int image_ = -1;
  /** Ball of the current image; radius 0 if there is none. */
  Circle ball_;
  double visible_ = 0;
  /** Least visible fraction of the current image's ball, with which it is learnt. */
  double least_visible_ = 0;
};

}  // namespace nao::vision
