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

  /** @param network  Network of shape(). @param radius  m. */
  explicit BallDetector(std::shared_ptr<NeuralNetwork> network, double radius = kBallRadius)
      : network_(std::move(network)), radius_(radius) {}

  std::optional<Detection> detect(const PatchSampler& sampler, const CameraGeometry& geometry,
                                  const std::vector<Circle>& places) const;

  /** Judges circles. @param with_mirrored  Also judges the mirrored patches; each result is then
   * the mean of both. @return In their order, with the circles that the network sees. */
  std::vector<BallCandidate> judge(const PatchSampler& sampler, const std::vector<Circle>& circles,
                                   bool with_mirrored = false) const;

 private:
  std::shared_ptr<NeuralNetwork> network_;
  double radius_;
};

}  // namespace nao::vision
