// The viewer, without a screen, with simulated mouse input.

#include <gtest/gtest.h>
#include <imgui.h>

#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "common/bus.h"
#include "common/data_path.h"
#include "common/wall_clock.h"
#include "rendering/decode_state.h"
#include "rendering/egl_context.h"
#include "rendering/gl_objects.h"
#include "test/daemons/head-camera/truth.h"
#include "viewer/viewer.h"

namespace nao::viewer {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 800;

class ViewerMouse : public testing::Test {
 protected:
  ViewerMouse()
      : model_(RobotModel::load(data_path() / "robots" / "nao")),
        bus_("memq://"),
        framebuffer_(kWidth, kHeight) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = {kWidth, kHeight};
    ViewerOptions options;
    options.view = {30, 20, 2, 0, 0, 0.2};
    options.follow = false;
    options.without_panels = true;
    viewer_ = std::make_unique<Viewer>(model_, &bus_, options);
    camera_.azimuth = 30 * M_PI / 180;
    camera_.elevation = 20 * M_PI / 180;
    camera_.distance = 2;
    camera_.target = {0, 0, 0.2};
    bus_.subscribe<naolcm::world_command_t>(
        kWorldCommandChannel, Bus::Queue::kAll,
        [this](const naolcm::world_command_t& command) { commands_.push_back(command); });
    truth_ = make_truth(model_, "StandInit", 0.32);
    truth_.has_ball = 1;
    truth_.position_ball_in_world[0] = 0.3;
    truth_.position_ball_in_world[1] = 0.2;
    truth_.position_ball_in_world[2] = 0.05;
    truth_.orientation_ball_in_world[0] = 1;
    bus_.publish(kWorldTruthChannel, truth_);
    frame();
    commands_.clear();
  }
  ~ViewerMouse() override {
    viewer_.reset();
    ImGui::DestroyContext();
  }

  void frame() {
    while (bus_.handle_for(0)) {
    }
    ImGui::GetIO().DeltaTime = 0.2f;
    viewer_->draw(framebuffer_.id(), kWidth, kHeight, now_ += 0.2);
    while (bus_.handle_for(0)) {
    }
  }

  /** Moves the mouse to the pixel of a point in the world. */
  void point_at(const Eigen::Vector3d& point) {
    const Eigen::Vector2d pixel =
        camera_.pinhole(kWidth, kHeight).project(camera_.pose().inverse() * point);
    ImGui::GetIO().MousePos = {static_cast<float>(pixel.x() + 0.5),
                               static_cast<float>(pixel.y() + 0.5)};
    frame();
  }

  void press(bool is_down) {
    ImGui::GetIO().MouseDown[ImGuiMouseButton_Left] = is_down;
    frame();
  }

  RobotModel model_;
  RobotModels models_{model_};
  Bus bus_;
  EglContext context_;
  gl::Framebuffer framebuffer_;
  OrbitCamera camera_;
  std::unique_ptr<Viewer> viewer_;
  naolcm::world_truth_t truth_;
  std::vector<naolcm::world_command_t> commands_;
  double now_ = monotonic_seconds();
};

TEST_F(ViewerMouse, DragsTheBallOverTheGround) {
  point_at({0.3, 0.2, 0.05});
  press(true);
  point_at({0.5, -0.1, 0.05});
  press(false);
  ASSERT_FALSE(commands_.empty());
  EXPECT_EQ(commands_.back().command, "place-ball");
  EXPECT_NEAR(commands_.back().position_in_world[0], 0.5, 0.01);
  EXPECT_NEAR(commands_.back().position_in_world[1], -0.1, 0.01);
}

TEST_F(ViewerMouse, PushesTheLinkThatIsDraggedWithControlHeld) {
  const auto poses =
      link_poses_in_world(model_, decode_truth(models_, truth_).robots[0].pose_torso_in_world,
                          decode_truth(models_, truth_).robots[0].position);
  const Link& root = model_.links()[0];
  const Eigen::Vector3d center = poses[0] * root.center_of_mass;
#if IMGUI_VERSION_NUM >= 18900
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, true);
#else
  ImGui::GetIO().KeyCtrl = true;
  ImGui::GetIO().KeyMods = ImGuiKeyModFlags_Ctrl;
#endif
  point_at(center);
  press(true);
  point_at(center + Eigen::Vector3d(0, 0.3, 0));
  EXPECT_TRUE(commands_.empty()) << "the push is sent when the button is released";
  press(false);
  ASSERT_FALSE(commands_.empty());
  const naolcm::world_command_t& push = commands_.front();
  EXPECT_EQ(push.command, "push");
  EXPECT_EQ(push.robot, truth_.robots[0].robot);
  EXPECT_FALSE(push.link.empty());
  EXPECT_NEAR(push.impulse_in_world[1], 1.5, 0.4) << "5 N s for each metre";
  EXPECT_NEAR(push.impulse_in_world[2], 0, 1e-9) << "horizontal";
}

TEST_F(ViewerMouse, RotatesTheViewWhereNothingIsGrabbed) {
  point_at({-0.6, -0.6, 0});
  press(true);
  point_at({-0.3, -0.6, 0});
  press(false);
  EXPECT_TRUE(commands_.empty());
}

}  // namespace
}  // namespace nao::viewer
