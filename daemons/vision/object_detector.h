#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "daemons/vision/neural_network.h"
#include "daemons/vision/patch_sampler.h"

namespace nao::vision {

/** Objects that ObjectDetector finds in an image. */
struct FoundObjects {
  /** Where a ball may be, most probable first. */
  std::vector<Circle> balls;
  Detections posts;
  Detections robots;
};

/** Finds goal posts, other robots and places of balls by a network that sees the whole image.
 *
 * The network divides the image into cells. For each cell it gives the probability that an object's
 * center (of posts: the foot) is there, and the exact position of its parts. */
class ObjectDetector {
 public:
  /** Rows and columns of the network's input, the image at half of its size. */
  static constexpr int kRows = 240;
  static constexpr int kColumns = 320;
  static NeuralNetwork::Shape shape();

  /** @param network  Network of shape(). */
  explicit ObjectDetector(std::shared_ptr<NeuralNetwork> network) : network_(std::move(network)) {}

  /** @param half  The image at half of its size, 8 bits a color, blue first.
   * @param width, height  Size of the image, pixels. */
  FoundObjects detect(const cv::Mat& half, int width, int height,
                      const CameraGeometry& geometry) const;

 private:
  std::shared_ptr<NeuralNetwork> network_;
};

}  // namespace nao::vision
