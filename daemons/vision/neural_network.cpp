#include "daemons/vision/neural_network.h"

#include <array>
#include <cmath>

#include "common/error.h"

namespace nao::vision {
namespace {

/** Added to the standard deviation, levels of 255: a uniform image stays near 0. */
constexpr double kLeastDeviation = 4;

/** Writes an image as 3 planes with mean 0 and deviation 1. */
void normalize(const cv::Mat& image, float* target) {
  cv::Scalar means;
  cv::Scalar deviations;
  cv::meanStdDev(image, means, deviations);
  double mean = 0;
  double mean_square = 0;
  for (int color = 0; color < 3; ++color) {
    mean += means[color] / 3;
    mean_square += (means[color] * means[color] + deviations[color] * deviations[color]) / 3;
  }
  const double deviation = std::sqrt(std::max(0.0, mean_square - mean * mean));
  const double scale = 1 / (deviation + kLeastDeviation);
  std::array<cv::Mat, 3> planes;
  cv::split(image, planes.data());
  for (const cv::Mat& plane : planes) {
    cv::Mat out(image.rows, image.cols, CV_32F, target);
    plane.convertTo(out, CV_32F, scale, -mean * scale);
    target += image.total();
  }
}

}  // namespace

NeuralNetwork::NeuralNetwork(const std::filesystem::path& file, const Shape& shape)
    : file_(file), shape_(shape) {
  if (!std::filesystem::is_regular_file(file)) {
    throw Error("the network " + file.string() + " is missing; build or install the project again");
  }
  try {
    net_ = cv::dnn::readNetFromONNX(file.string());
    net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    run({cv::Mat::zeros(shape.input, CV_8UC3)});
  } catch (const cv::Exception& error) {
    throw Error("the network " + file.string() +
                " cannot be read; build or install the project again: " + error.err);
  }
}

cv::Mat_<float> NeuralNetwork::run(const std::vector<cv::Mat>& images) {
  const int num_numbers = shape_.num_outputs * shape_.output.area();
  const int count = static_cast<int>(images.size());
  if (count == 0) return cv::Mat_<float>(0, num_numbers);
  const std::array<int, 4> sizes = {count, 3, shape_.input.height, shape_.input.width};
  cv::Mat input(4, sizes.data(), CV_32F);
  for (int i = 0; i < count; ++i) normalize(images[i], input.ptr<float>(i));
  net_.setInput(input);
  const cv::Mat output = net_.forward();
  if (output.type() != CV_32F ||
      output.total() != static_cast<size_t>(count) * static_cast<size_t>(num_numbers)) {
    throw Error("the network " + file_.string() + " has " +
                std::to_string(output.total() / images.size()) + " outputs where " +
                std::to_string(num_numbers) + " are needed; build or install the project again");
  }
  return output.reshape(1, count).clone();
}

}  // namespace nao::vision
