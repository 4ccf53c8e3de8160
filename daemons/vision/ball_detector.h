#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "daemons/vision/ball_filter.h"
#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "daemons/vision/neural_network.h"
#include "daemons/vision/patch_sampler.h"

namespace nao::vision {

/** Something round, and whether it is a ball. */
struct BallCandidate {
  Circle circle;
  /** Logarithm of the odds of a ball. */
  float log_odds = 0;

  /** 0 to 1. */
  float probability() const { return 1 / (1 + std::exp(-log_odds)); }
};

/** Networks that judge patches, of BallDetector::shape(). */
struct BallNetworks {
  /** Of balls with light and dark faces. */
  std::shared_ptr<NeuralNetwork> patterned;
  /** Of balls of one color. */
  std::shared_ptr<NeuralNetwork> colored;
};

/** Decides which of the possible places has the ball.
 *
 * A network judges a patch around each place, and tells where in it the ball's circle lies. The
 * best ones are judged again by patches around those circles and by the mirrored patches. The mean
 * of the three log odds decides: what is not a ball often looks like one in one of them only. */
class BallDetector {
 public:
  /** Outputs of the network: log odds of a ball; offset of its center to the right and downwards,
   * and logarithm of its radius, in radii of the circle that the patch was made for. */
  static constexpr int kNumOutputs = 4;
  /** Half of a patch's width, radii of its circle. */
  static constexpr float kPatchRadii = 2.4f;
  /** Least probability of a detection. Chosen on 3100 mixed images of places 1000 to 1599 and 4000
   * to 4499 and 532 hard ones of places 8000 to 8531: from 0.96 to 0.97 and 0.98 the false
   * detections of the last 2500 mixed ones fall from 7 to 2, at a loss of 0.2 % of the balls. */
  static constexpr float kAccept = 0.97f;
  /** The same for a ball that the lower border of the image cuts, which shows less of its pattern:
   * most of the false detections are there. */
  static constexpr float kAcceptCut = 0.98f;

  static NeuralNetwork::Shape shape();

  /** Saturation from red to yellow of the middle of a patch, (R - min(G, B)) / (R + G + B); 0 of
   * other colors. */
  static double saturation(const cv::Mat& patch);
  /** From this saturation on the network of balls of one color judges a patch, too. Chosen on the
   * tuning places: 98 % of orange balls are above, white ones in warm light reach it. */
  static constexpr double kColored = 0.11;

  /** @param radius  m. */
  explicit BallDetector(BallNetworks networks, double radius = kBallRadius)
      : networks_(std::move(networks)), radius_(radius) {}

  std::optional<Detection> detect(const PatchSampler& sampler, const CameraGeometry& geometry,
                                  const std::vector<Circle>& places) const;

  /** Judges circles. @param with_mirrored  Also judges the mirrored patches; each result is then
   * the mean of both. @return In their order, with the circles that the network sees. */
  std::vector<BallCandidate> judge(const PatchSampler& sampler, const std::vector<Circle>& circles,
                                   bool with_mirrored = false) const;

 private:
  /** Outputs for patches in their order. */
  cv::Mat_<float> run(const std::vector<cv::Mat>& patches) const;

  BallNetworks networks_;
  double radius_;
};

}  // namespace nao::vision
