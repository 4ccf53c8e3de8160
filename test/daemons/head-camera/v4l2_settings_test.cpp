#include "daemons/head-camera/v4l2_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include "common/data_path.h"
#include "common/error.h"
#include "robot_model/robot_model.h"

namespace nao::camera {
namespace {

RobotModel load(const std::string& name) {
  return RobotModel::load(data_path() / "robots" / name);
}

TEST(V4l2Settings, ReadsTheV6sCameras) {
  const V4l2Settings settings = V4l2Settings::load(load("nao_v6"), {});
  ASSERT_EQ(settings.cameras.size(), 2u);
  EXPECT_EQ(settings.cameras[0].device, "/dev/video-top");
  EXPECT_EQ(settings.cameras[1].camera, "bottom");
  ASSERT_EQ(settings.cameras[0].extensions.size(), 2u);
  EXPECT_EQ(settings.cameras[0].extensions[1].selector, 13);
  EXPECT_EQ(settings.cameras[0].controls[2].id, static_cast<uint32_t>(V4L2_CID_CONTRAST));
  ASSERT_TRUE(settings.reset);
  EXPECT_EQ(settings.reset->address, 0x41);
  EXPECT_EQ(settings.reset->writes[1].value, 0xf3);
}

TEST(V4l2Settings, DevicesReplaceThoseOfTheFile) {
  const V4l2Settings settings = V4l2Settings::load(load("nao_v6"), {"bottom=/dev/video7"});
  ASSERT_EQ(settings.cameras.size(), 1u);
  EXPECT_EQ(settings.cameras[0].device, "/dev/video7");
  EXPECT_EQ(settings.cameras[0].extensions.size(), 2u);
  // A robot without the file: no controls, the first camera.
  const V4l2Settings other = V4l2Settings::load(load("nao"), {"/dev/video0"});
  EXPECT_EQ(other.cameras[0].camera, "top");
  EXPECT_TRUE(other.cameras[0].controls.empty());
}

TEST(V4l2Settings, NamesWhatIsWrong) {
  EXPECT_THROW((void)V4l2Settings::load(load("nao"), {}), ConfigError);
  EXPECT_THROW((void)V4l2Settings::load(load("nao"), {"tail=/dev/video0"}), ConfigError);
  EXPECT_THROW((void)V4l2Settings::load(load("nao"), {"top="}), ConfigError);
}

}  // namespace
}  // namespace nao::camera
