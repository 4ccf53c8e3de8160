#include "daemons/motion/walk/lag_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace nao::motion {
namespace {

/** Two joints that follow what was commanded `lag` seconds ago, with the steps of an encoder and a
 * wrong zero. */
class LaggingJoints {
 public:
  LaggingJoints(double lag, double tick) : lag_(lag), tick_(tick) {}

  void run(LagEstimator& estimator, double duration, double amplitude) {
    const double end = time_ + duration;
    for (; time_ < end; time_ += tick_) {
      // The last command was given one tick ago.
      estimator.update(angles(time_ - tick_, amplitude), measured(amplitude), {0, 2}, tick_);
    }
  }

 private:
  static std::vector<double> angles(double time, double amplitude) {
    return {amplitude * std::sin(12 * time), 7.0, amplitude * std::cos(25 * time)};
  }
  std::vector<double> measured(double amplitude) const {
    constexpr double kEncoderStep = 2 * M_PI / 4096;
    constexpr double kZero = 0.01;
    std::vector<double> result = angles(time_ - lag_, amplitude);
    for (double& angle : result) {
      angle = std::round((angle + kZero) / kEncoderStep) * kEncoderStep;
    }
    return result;
  }

  double lag_;
  double tick_;
  double time_ = 0;
};

TEST(LagEstimator, MeasuresTheLagOfMovingJoints) {
  for (const double tick : {0.01, 0.012}) {
    for (const double lag : {0.024, 0.037, 0.055}) {
      LagEstimator estimator;
      estimator.start(0.025);
      LaggingJoints(lag, tick).run(estimator, 1.5, 0.2);
      EXPECT_NEAR(estimator.lag(), lag, 0.15 * tick) << "lag " << lag << ", tick " << tick;
    }
  }
}

TEST(LagEstimator, KeepsTheLagWhileTheJointsRest) {
  LagEstimator estimator;
  estimator.start(0.025);
  LaggingJoints joints(0.05, 0.01);
  joints.run(estimator, 2, 0);
  EXPECT_EQ(estimator.lag(), 0.025);
}

TEST(LagEstimator, KeepsTheLagWhileTheJointsAreHeld) {
  LagEstimator estimator;
  estimator.start(0.025);
  for (int tick = 0; tick < 200; ++tick) {
    estimator.update({0.2 * std::sin(0.12 * tick)}, {0.1}, {0}, 0.01);
  }
  EXPECT_EQ(estimator.lag(), 0.025);
}

}  // namespace
}  // namespace nao::motion
