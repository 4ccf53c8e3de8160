#include "calibration/calibration.h"

#include <gtest/gtest.h>

#include <string>

#include "common/error.h"
#include "common/random.h"
#include "test/daemons/motion/nao_model.h"

namespace nao {
namespace {

using motion::nao_model;
using motion::nao_motor;

Calibration example() {
  Calibration calibration(nao_model());
  calibration.date = "2026-01-31 12:00 UTC";
  calibration.joint_zero[nao_motor("LKneePitch")] = 0.00873;
  calibration.joint_zero[nao_motor("RAnkleRoll")] = -0.0125;
  calibration.imu_mount = {0.012, -0.008, 0};
  calibration.gyroscope_offset = {0.01, 0.02, -0.03};
  calibration.gyroscope_scale = {0.965, 1, 1.076};
  calibration.foot_sensor_scale = {1, 0.7, 1.3, 0, 1, 1, 1, 1.1};
  return calibration;
}

std::string error_of(const std::string& text) {
  try {
    Calibration::parse(nao_model(), text, "calibration.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Calibration, WhatIsWrittenIsRead) {
  const Calibration written = example();
  const Calibration read = Calibration::parse(nao_model(), written.to_yaml(nao_model()), "text");
  EXPECT_EQ(read.date, written.date);
  for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
    EXPECT_NEAR(read.joint_zero[motor], written.joint_zero[motor], 1e-5);
  }
  EXPECT_LT((read.imu_mount - written.imu_mount).norm(), 1e-5);
  EXPECT_LT((read.gyroscope_offset - written.gyroscope_offset).norm(), 1e-5);
  EXPECT_LT((read.gyroscope_scale - written.gyroscope_scale).norm(), 1e-5);
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(read.foot_sensor_scale[i], written.foot_sensor_scale[i], 1e-3);
  }
}

TEST(Calibration, NoDifferenceIsWrittenAndReadToo) {
  const Calibration none(nao_model());
  const Calibration read = Calibration::parse(nao_model(), none.to_yaml(nao_model()), "text");
  EXPECT_EQ(read.joint_zero, none.joint_zero);
  EXPECT_EQ(read.foot_sensor_scale, none.foot_sensor_scale);
}

TEST(Calibration, ErrorsNameFileLineAndKey) {
  EXPECT_NE(error_of("date: x\njoint_zero: {Nose: 0.1}").find("calibration.yaml:2"),
            std::string::npos);
  EXPECT_NE(error_of("joint_zero: {Nose: 0.1}").find("joint_zero.Nose"), std::string::npos);
  EXPECT_NE(error_of("joint_zero: {LKneePitch: 5}").find("outside [-0.35, 0.35]"),
            std::string::npos);
  EXPECT_NE(error_of("imu_mount: [0, 0]").find("3 numbers"), std::string::npos);
  EXPECT_NE(error_of("gyroscope_scale: [0, 1, 1]").find("outside"), std::string::npos);
  EXPECT_NE(error_of("foot_sensor_scale: {LFsrFL: .nan}"), "");
  EXPECT_NE(error_of("joint_zeros: {}").find("joint_zeros"), std::string::npos);
  EXPECT_NE(error_of("date: ["), "");
}

TEST(Calibration, DamagedFilesAreReadOrRefused) {
  const std::string text = example().to_yaml(nao_model());
  Random random(1);
  for (int round = 0; round < 3000; ++round) {
    std::string damaged = text;
    const int num_damages = 1 + static_cast<int>(random.uniform() * 4);
    for (int i = 0; i < num_damages; ++i) {
      const auto place =
          static_cast<size_t>(random.uniform() * static_cast<double>(damaged.size()));
      const double kind = random.uniform();
      if (kind < 0.4) {
        damaged[place] = static_cast<char>(random.uniform() * 256);
      } else if (kind < 0.7) {
        damaged.erase(place, 1 + static_cast<size_t>(random.uniform() * 20));
      } else {
        damaged.insert(place, damaged.substr(0, static_cast<size_t>(random.uniform() * 30)));
      }
    }
    // A message, or a calibration within its bounds; never anything else.
    try {
      const Calibration read = Calibration::parse(nao_model(), damaged, "damaged");
      for (const double zero : read.joint_zero) ASSERT_LE(std::abs(zero), 0.35);
    } catch (const ConfigError& error) {
      ASSERT_NE(std::string(error.what()).find("damaged"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace nao
