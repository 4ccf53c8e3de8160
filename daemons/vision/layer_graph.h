#pragma once

#include <istream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "daemons/vision/convolution.h"

namespace nao::vision {

namespace onnx {
class Node;
class Tensor;
}  // namespace onnx

/** The layers of a convolutional network, read from an ONNX file, and the memory that they need.
 *
 * It knows the layers of the networks that tools/vision-train makes: "Conv" with square kernels,
 * "Relu" after a convolution or an addition, "Resize" to twice the size before an addition, "Add",
 * and "Concat" of channels at the end. */
class LayerGraph {
 public:
  /** @param rows, columns  Of the image. @throws Error  if the file is damaged, or has other
   * layers. */
  LayerGraph(std::istream& file, int rows, int columns);

  /** Where the caller writes the image, 3 channels. */
  Activations& image() { return values_.front(); }
  /** Computes the layers for image(). */
  void run();

  /** Rows, columns and planes of the output. */
  int output_rows() const { return values_[outputs_.front().value].rows; }
  int output_columns() const { return values_[outputs_.front().value].columns; }
  int num_outputs() const;
  /** Writes the output of the last run(): one plane after the other, each row by row. */
  void copy_output(float* target) const;

 private:
  /** A name of the file. */
  struct Named {
    size_t value = 0;
    /** Channels that are not only padding. */
    int channels = 0;
    /** 2: each place stands for 2x2. */
    int scale = 1;
  };
  struct Layer {
    /** Nothing: the sum of two values, of which the second may be scaled. */
    std::shared_ptr<const Convolution> convolution;
    Named first;
    Named second;
    size_t output = 0;
    bool is_rectified = false;
  };
  using Tensors = std::map<std::string, const onnx::Tensor*>;

  void add(const onnx::Node& node, Tensors& tensors);
  void add_convolution(const onnx::Node& node, const Tensors& tensors);
  void add_sum(const onnx::Node& node);
  /** The named result of an earlier node. @throws Error  if there is none. */
  const Named& find(const std::string& name) const;
  /** Adds the value that the newest layer writes. */
  Named add_value(int rows, int columns, int channels);
  void run_sum(const Layer& layer);

  std::vector<Activations> values_;
  std::vector<Layer> layers_;
  std::map<std::string, Named> names_;
  std::vector<Named> outputs_;
};

}  // namespace nao::vision
