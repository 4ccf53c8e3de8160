#include "daemons/vision/neural_network.h"

#include <gmock/gmock.h>

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "common/data_path.h"
#include "common/error.h"
#include "common/random.h"
#include "daemons/vision/ball_detector.h"
#include "daemons/vision/object_detector.h"
#include "test/support/temporary_folder.h"

namespace nao::vision {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::filesystem::path network_file(const std::string& name) {
  return data_path() / "networks" / name;
}

/** Patches with blobs of random colors. */
std::vector<cv::Mat> random_patches(int count) {
  Random random(3);
  std::vector<cv::Mat> patches;
  for (int i = 0; i < count; ++i) {
    cv::Mat patch(PatchSampler::kSize, PatchSampler::kSize, CV_8UC3, cv::Scalar(50, 120, 60));
    for (int k = 0; k < 5; ++k) {
      cv::circle(patch,
                 {static_cast<int>(random.uniform(0, 32)), static_cast<int>(random.uniform(0, 32))},
                 static_cast<int>(random.uniform(2, 9)),
                 {random.uniform(0, 255), random.uniform(0, 255), random.uniform(0, 255)}, -1);
    }
    patches.push_back(patch);
  }
  return patches;
}

/** The first `size` bytes of a network's file and then zeros, up to `total` bytes. */
std::string damaged(const std::string& name, size_t size, size_t total) {
  std::string bytes = read_text(network_file(name));
  bytes.resize(size);
  bytes.resize(total);
  return bytes;
}

/** What OpenCV computes by a network for one image, in the order of NeuralNetwork's output. */
cv::Mat_<float> run_by_opencv(const std::string& name, const cv::Mat& image) {
  cv::Mat numbers;
  image.convertTo(numbers, CV_32F);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(numbers.reshape(1), mean, deviation);
  cv::dnn::Net net = cv::dnn::readNetFromONNX(network_file(name).string());
  net.setInput(cv::dnn::blobFromImage(cv::Mat(numbers.reshape(1) - mean[0]).reshape(3),
                                      1 / (deviation[0] + 4)));
  return net.forward().reshape(1, 1).clone();
}

TEST(NeuralNetwork, GivesTheNumbersOfOpenCv) {
  const cv::Mat patch = random_patches(1).front();
  for (const auto& [name, shape] : {std::pair{"ball.onnx", BallDetector::shape()},
                                    std::pair{"colored_ball.onnx", BallDetector::shape()},
                                    std::pair{"objects.onnx", ObjectDetector::shape()}}) {
    cv::Mat image;
    cv::resize(patch, image, shape.input);
    const cv::Mat_<float> expected = run_by_opencv(name, image);
    const cv::Mat_<float> output = NeuralNetwork(network_file(name), shape).run({image});
    ASSERT_EQ(output.total(), expected.total()) << name;
    EXPECT_GT(cv::norm(expected, cv::NORM_INF), 1) << name;
    // Sums of some hundred products in another order, in each of ten layers.
    EXPECT_LT(cv::norm(output, expected, cv::NORM_INF), 1e-4) << name;
  }
}

TEST(NeuralNetwork, JudgesSeveralPatchesAsEachAlone) {
  NeuralNetwork network(network_file("ball.onnx"), BallDetector::shape());
  const std::vector<cv::Mat> patches = random_patches(7);
  const cv::Mat_<float> together = network.run(patches);
  ASSERT_EQ(together.rows, 7);
  ASSERT_EQ(together.cols, BallDetector::kNumOutputs);
  for (int i = 0; i < 7; ++i) {
    const cv::Mat_<float> alone = network.run({patches[static_cast<size_t>(i)]});
    for (int k = 0; k < BallDetector::kNumOutputs; ++k) {
      EXPECT_EQ(together(i, k), alone(0, k));
    }
  }
}

TEST(NeuralNetwork, GivesEqualBitsForEqualImages) {
  NeuralNetwork first(network_file("ball.onnx"), BallDetector::shape());
  NeuralNetwork second(network_file("ball.onnx"), BallDetector::shape());
  const std::vector<cv::Mat> patches = random_patches(5);
  const cv::Mat a = first.run(patches);
  // Another number of patches in between leaves nothing behind.
  first.run(random_patches(2));
  EXPECT_EQ(cv::norm(a, first.run(patches), cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a, second.run(patches), cv::NORM_INF), 0);
}

TEST(NeuralNetwork, DoesNotDependOnTheExposure) {
  NeuralNetwork network(network_file("ball.onnx"), BallDetector::shape());
  std::vector<cv::Mat> patches = random_patches(4);
  const cv::Mat_<float> bright = network.run(patches);
  for (cv::Mat& patch : patches) patch *= 0.7;
  const cv::Mat_<float> dark = network.run(patches);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(bright(i, 0), dark(i, 0), 0.15 * std::abs(bright(i, 0)) + 1);
}

TEST(NeuralNetwork, JudgesNoPatches) {
  NeuralNetwork network(network_file("ball.onnx"), BallDetector::shape());
  EXPECT_EQ(network.run({}).rows, 0);
}

TEST(NeuralNetwork, RefusesBrokenFiles) {
  const auto load = [](const std::filesystem::path& file) {
    return [file] { NeuralNetwork network(file, BallDetector::shape()); };
  };
  EXPECT_THAT(load("/no/such/ball.onnx"),
              ThrowsMessage<Error>(HasSubstr("network /no/such/ball.onnx is missing")));
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "damaged.onnx";
  write_text(file, "");
  EXPECT_THAT(load(file), ThrowsMessage<Error>(HasSubstr("cannot be read")));
  write_text(file, damaged("ball.onnx", 40000, 40000));
  EXPECT_THAT(load(file), ThrowsMessage<Error>(HasSubstr("damaged.onnx")));
  write_text(file, damaged("ball.onnx", 100, 100000));
  EXPECT_THAT(load(file), ThrowsMessage<Error>(HasSubstr("damaged.onnx")));
}

TEST(NeuralNetwork, RefusesLayersThatItDoesNotKnow) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "tanh.onnx";
  std::string bytes = read_text(network_file("ball.onnx"));
  // The kind (field 4, 4 bytes) of the second layer; the same length, so that the file stays whole.
  bytes.replace(bytes.find("\x22\x04Relu") + 2, 4, "Tanh");
  write_text(file, bytes);
  EXPECT_THAT([&] { NeuralNetwork network(file, BallDetector::shape()); },
              ThrowsMessage<Error>(HasSubstr("(Tanh) is of an unknown kind")));
}

TEST(NeuralNetwork, RefusesAnotherNetwork) {
  EXPECT_THAT([] { NeuralNetwork network(network_file("objects.onnx"), BallDetector::shape()); },
              ThrowsMessage<Error>(HasSubstr("objects.onnx")));
  EXPECT_THAT([] { NeuralNetwork network(network_file("ball.onnx"), ObjectDetector::shape()); },
              ThrowsMessage<Error>(HasSubstr("ball.onnx")));
}

}  // namespace
}  // namespace nao::vision
