#pragma once

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
  /** 0 to 1. */
  float probability = 0;
};

/** Decides which of the possible places has the ball.
 *
 * A network judges a patch around each place, and tells where in it the ball's circle lies. The
 * best ones are judged again by patches around those circles. */
class BallDetector {
 public:
  /** Outputs of the network: log odds of a ball; offset of its center to the right and downwards,
   * and logarithm of its radius, in radii of the circle that the patch was made for. */
  static constexpr int kNumOutputs = 4;
  /** Half of a patch's width, radii of its circle. */
  static constexpr float kPatchRadii = 2.4f;
  /** Least probability of a detection. Chosen on 5000 images of places 1000 to 1499 and 6000
   * without a ball of places 2000 to 2199, 3000 to 3199 and 6000 to 6199: from 0.9 to 0.985 the
   * false detections fall to an eighth, most of them smaller than 9 pixels, at a loss of 0.5 % of
   * the balls up to 3 m and 4 % of those from 3 to 5 m. */
  static constexpr float kAccept = 0.985f;
  /** The same for a ball that the lower border of the image cuts: it lies in front of the robot's
   * feet, where little else is round, and shows less of its pattern. Chosen on a real image. */
  static constexpr float kAcceptCut = 0.7f;

  static NeuralNetwork::Shape shape();

  /** @param network  Network of shape(). @param radius  m. */
  explicit BallDetector(std::shared_ptr<NeuralNetwork> network, double radius = kBallRadius)
      : network_(std::move(network)), radius_(radius) {}

  std::optional<Detection> detect(const PatchSampler& sampler, const CameraGeometry& geometry,
                                  const std::vector<Circle>& places) const;

  /** Judges circles once. @return In their order, with the circles that the network sees. */
  std::vector<BallCandidate> judge(const PatchSampler& sampler,
                                   const std::vector<Circle>& circles) const;

 private:
  std::shared_ptr<NeuralNetwork> network_;
  double radius_;
};

}  // namespace nao::vision
