#include "daemons/vision/neural_network.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "common/error.h"

namespace nao::vision {
namespace {

/** Added to the standard deviation, levels of 255: a uniform image stays near 0. */
constexpr double kLeastDeviation = 4;

LayerGraph load(const std::filesystem::path& file, const cv::Size& input) {
  if (!std::filesystem::is_regular_file(file)) {
    throw Error("the network " + file.string() + " is missing; build or install the project again");
  }
  try {
    std::ifstream stream(file, std::ios::binary);
    return {stream, input.height, input.width};
  } catch (const Error& error) {
    throw Error("the network " + file.string() +
                " cannot be read; build or install the project again: " + error.what());
  }
}

/** Writes an image with mean 0 and deviation 1. */
void normalize(const cv::Mat& image, Activations& target) {
  const int row_size = 3 * image.cols;
  int64_t sum = 0;
  int64_t sum_of_squares = 0;
  for (int y = 0; y < image.rows; ++y) {
    const uint8_t* row = image.ptr(y);
    // Rows are short enough for 32 bits.
    uint32_t row_sum = 0;
    uint32_t row_squares = 0;
    for (int i = 0; i < row_size; ++i) {
      row_sum += row[i];
      row_squares += static_cast<uint32_t>(row[i]) * row[i];
    }
    sum += row_sum;
    sum_of_squares += row_squares;
  }
  const auto count = static_cast<double>(image.rows) * row_size;
  const double mean = static_cast<double>(sum) / count;
  const double mean_square = static_cast<double>(sum_of_squares) / count;
  const double deviation = std::sqrt(std::max(0.0, mean_square - mean * mean));
  const auto scale = static_cast<float>(1 / (deviation + kLeastDeviation));
  const float offset = -static_cast<float>(mean) * scale;
  for (int y = 0; y < image.rows; ++y) {
    const uint8_t* row = image.ptr(y);
    float* out = target.at(y, 0);
    for (int i = 0; i < row_size; ++i) out[i] = static_cast<float>(row[i]) * scale + offset;
  }
}

}  // namespace

NeuralNetwork::NeuralNetwork(const std::filesystem::path& file, const Shape& shape)
    : shape_(shape), layers_(load(file, shape.input)) {
  if (layers_.num_outputs() != shape.num_outputs || layers_.output_rows() != shape.output.height ||
      layers_.output_columns() != shape.output.width) {
    throw Error("the network " + file.string() + " has " + std::to_string(layers_.num_outputs()) +
                " outputs for " + std::to_string(layers_.output_columns()) + "x" +
                std::to_string(layers_.output_rows()) + " places where " +
                std::to_string(shape.num_outputs) + " for " + std::to_string(shape.output.width) +
                "x" + std::to_string(shape.output.height) +
                " are needed; build or install the project again");
  }
}

cv::Mat_<float> NeuralNetwork::run(const std::vector<cv::Mat>& images) {
  cv::Mat_<float> outputs(static_cast<int>(images.size()),
                          shape_.num_outputs * shape_.output.area());
  for (int i = 0; i < outputs.rows; ++i) {
    normalize(images[static_cast<size_t>(i)], layers_.image());
    layers_.run();
    layers_.copy_output(outputs[i]);
  }
  return outputs;
}

}  // namespace nao::vision
