#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

#include "daemons/vision/layer_graph.h"

namespace nao::vision {

/** A small convolutional network that judges images of one size.
 *
 * Each image is shifted and scaled to mean 0 and standard deviation 1 over its pixels and colors,
 * so that the exposure does not matter. The networks are trained by tools/vision-train. */
class NeuralNetwork {
 public:
  /** Sizes of a network's input and output. */
  struct Shape {
    cv::Size input;
    /** Numbers for each place of the output. */
    int num_outputs = 0;
    cv::Size output;
  };

  /** @param file  ONNX; input N x 3 x rows x columns, output N x num_outputs x rows x columns.
   * @throws Error  if it cannot be read, or is not such a network. */
  NeuralNetwork(const std::filesystem::path& file, const Shape& shape);

  /** @param images  Images of the input's size, 8 bits a color, blue first; one after the other.
   * @return A row for each image: one plane of the output's size after the other. */
  cv::Mat_<float> run(const std::vector<cv::Mat>& images);

  const Shape& shape() const { return shape_; }

 private:
  Shape shape_;
  LayerGraph layers_;
};

}  // namespace nao::vision
