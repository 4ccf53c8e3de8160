#include "tools/vision-dataset/image_effects.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace nao::vision {

ImageEffects ImageEffects::of_place(Random& random) {
  ImageEffects effects;
  for (double& gain : effects.gain) gain = random.uniform(0.88, 1.12);
  effects.saturation = random.uniform(0.6, 1.25);
  if (random.uniform() < 0.4) effects.veil = random.uniform(0, 30);
  effects.noise = random.uniform(0.5, 7);
  return effects;
}

void ImageEffects::vary(Random& random) {
  // Some images are far too bright, as when a robot turns from a window to the field.
  const double exposure =
      std::exp(random.uniform() < 0.15 ? random.uniform(0.2, 0.8) : 0.22 * random.normal());
  for (double& factor : gain) factor *= exposure;
  blur = random.uniform() < 0.5 ? random.uniform(0, 3) : random.uniform(0, 14);
  blur_angle = random.uniform(0, M_PI);
  if (random.uniform() < 0.4) defocus = random.uniform(0.3, 1.4);
  quality = static_cast<int>(random.uniform(55, 95));
  noise_seed = random.next();
}

void ImageEffects::apply(cv::Mat& bgr) const {
  if (blur > 1) {
    const int size = 2 * static_cast<int>(std::ceil(blur / 2)) + 1;
    cv::Mat kernel = cv::Mat::zeros(size, size, CV_32F);
    const double c = (size - 1) / 2.0;
    const cv::Point2d step(0.5 * blur * std::cos(blur_angle), 0.5 * blur * std::sin(blur_angle));
    cv::line(kernel, cv::Point2d(c - step.x, c - step.y), cv::Point2d(c + step.x, c + step.y), 1);
    kernel /= cv::sum(kernel)[0];
    cv::filter2D(bgr, bgr, -1, kernel);
  }
  if (defocus > 0) cv::GaussianBlur(bgr, bgr, {0, 0}, defocus);
  if (sharpening > 0) {
    cv::Mat smooth;
    cv::GaussianBlur(bgr, smooth, {0, 0}, 1);
    cv::addWeighted(bgr, 1 + sharpening, smooth, -sharpening, 0, bgr);
  }
  Random random(noise_seed);
  std::array<float, 4096> samples;
  for (float& sample : samples) sample = static_cast<float>(noise * random.normal());
  // Factors of each column and row; a normal curve of two dimensions is their product.
  const auto curve = [](int count, double middle, double size) {
    std::vector<float> values(count);
    for (int i = 0; i < count; ++i) {
      const double way = (i - middle) / size;
      values[i] = static_cast<float>(std::exp(-0.5 * way * way));
    }
    return values;
  };
  const std::vector<float> across = curve(bgr.cols, glare_center.x, glare_size.x);
  const std::vector<float> down = curve(bgr.rows, glare_center.y, glare_size.y);
  for (int y = 0; y < bgr.rows; ++y) {
    const float glare_of_row = static_cast<float>(glare) * down[y];
    for (int x = 0; x < bgr.cols; ++x) {
      cv::Vec3b& pixel = bgr.at<cv::Vec3b>(y, x);
      const auto grey = static_cast<float>(pixel[0] + pixel[1] + pixel[2]) / 3;
      const uint64_t bits = random.next();
      for (int i = 0; i < 3; ++i) {
        const float color = grey + static_cast<float>(saturation) * (pixel[i] - grey);
        const float value = static_cast<float>(gain[i]) * (color + static_cast<float>(veil)) +
                            glare_of_row * across[x] + samples[(bits >> (12 * i)) % samples.size()];
        pixel[i] = static_cast<uint8_t>(std::clamp(value, 0.0f, 255.0f));
      }
    }
  }
}

}  // namespace nao::vision
