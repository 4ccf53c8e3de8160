#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <functional>
#include <optional>
#include <string>

#include "backends/imgui_impl_glfw.h"
#include "common/bus.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "rendering/egl_context.h"
#include "rendering/gl_objects.h"
#include "rendering/image.h"
#include "robot_model/robot_model.h"
#include "viewer/viewer.h"
#include "viewer/viewer_options.h"
#include "viewer/window.h"

namespace nao::viewer {
namespace {

/** Frames a second. Chosen: smooth, and leaves processor time to the simulator. */
constexpr double kRate = 30;

void add_options(nao::CommandLine& app, ViewerOptions& options) {
  app.add_option("--model", options.model, "Folder of robots/ that describes the robot shown");
  app.add_option("--log", options.log_file, "Log of lcm-logger to play instead of the bus")
      ->existing_file();
  app.add_option("--log-start", options.log_start, "Time in the log to start at, s");
  app.add_flag("--paused", options.is_paused, "Start with the log paused");
  app.add_option("--screenshot", options.screenshot, "Write a PNG file after --frames, then end");
  app.add_option("--frames", options.num_frames, "Frames before the screenshot, 30 a second");
  app.add_flag("--offscreen", options.is_offscreen, "Draw the screenshot without window or screen");
  app.add_flag("--no-panels", options.without_panels, "Show the 3D view only");
  app.add_option("--supersample", options.supersample,
                 "With --offscreen --no-panels: resolution factor, 1 to 4, before downsampling");
  app.add_option("--width", options.width, "Width, pixels");
  app.add_option("--height", options.height, "Height, pixels");
  app.add_option("--shadow-size", options.shadow_size,
                 "Greatest side of the shadow map, texels; 0: none");
  app.add_option("--view", options.view,
                 "Camera: azimuth and elevation (degrees), distance (m), and optionally the target "
                 "x, y, z (m)")
      ->separated_by(',');
  app.add_option("--plot", options.plots, "Curve at the start: CHANNEL:FIELD; can be repeated");
  app.add_option("--posture", options.waiting_posture, "Posture shown before a state is received");
  app.add_flag("!--no-follow", options.follow, "Do not follow the robot with the camera");
  app.add_flag("--no-marks", options.without_marks,
               "Show robots and ball only, no forces, footsteps and other markings");
  app.add_flag("--see-through", options.see_through, "Draw the estimated robot translucent");
}

void save(const ViewerOptions& options, unsigned framebuffer, int width, int height) {
  std::vector<uint8_t> pixels;
  gl::read_pixels(framebuffer, width, height, pixels);
  write_png(options.screenshot,
            downsampled(image_from_bgrx(width, height, pixels), options.supersample));
  nao::logger::info("wrote {}", options.screenshot);
}

/** Calls `draw(now)` at the frame rate until it returns false, and handles messages in between. */
void run_loop(EventLoop& loop, Bus* bus, const std::function<bool(double)>& draw) {
  if (bus != nullptr) loop.on_readable(bus->descriptor(), [bus] { bus->handle(); });
  loop.every(1 / kRate, [&] {
    if (!draw(monotonic_seconds())) loop.stop("done");
  });
  const double start = monotonic_seconds();
  const std::string reason = loop.run();
  nao::logger::info("{} after {:.1f} s", reason, monotonic_seconds() - start);
}

void report_rate(int64_t num_frames, double seconds) {
  if (seconds > 0) {
    nao::logger::info("{} frames, {:.1f} a second", num_frames,
                      static_cast<double>(num_frames) / seconds);
  }
}

void run_offscreen(EventLoop& loop, Bus* bus, const RobotModel& model,
                   const ViewerOptions& options) {
  const EglContext context;
  nao::logger::info("rendering with {}", SceneRenderer::driver());
  const ImGuiContextOwner imgui;
  const int width = options.width * options.supersample;
  const int height = options.height * options.supersample;
  const gl::Framebuffer framebuffer(width, height);
  Viewer viewer(model, bus, options);
  ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  const double start = monotonic_seconds();
  run_loop(loop, bus, [&](double now) {
    ImGui::GetIO().DeltaTime = static_cast<float>(1 / kRate);
    viewer.draw(framebuffer.id(), width, height, now);
    if (viewer.num_frames() < options.num_frames) return true;
    save(options, framebuffer.id(), width, height);
    return false;
  });
  report_rate(viewer.num_frames(), monotonic_seconds() - start);
}

void run_window(EventLoop& loop, Bus* bus, const RobotModel& model, const ViewerOptions& options) {
  const Window window(options.width, options.height);
  nao::logger::info("rendering with {}", SceneRenderer::driver());
  const ImGuiContextOwner imgui;
  ImGui_ImplGlfw_InitForOpenGL(window.get(), true);
  {
    Viewer viewer(model, bus, options);
    const double start = monotonic_seconds();
    run_loop(loop, bus, [&](double now) {
      glfwPollEvents();
      if (glfwWindowShouldClose(window.get()) != 0) return false;
      int width = 0;
      int height = 0;
      glfwGetFramebufferSize(window.get(), &width, &height);
      if (width < 1 || height < 1) return true;  // minimized
      ImGui_ImplGlfw_NewFrame();
      viewer.draw(0, width, height, now);
      const bool is_last = !options.screenshot.empty() && viewer.num_frames() >= options.num_frames;
      if (is_last) save(options, 0, width, height);
      glfwSwapBuffers(window.get());
      return !is_last;
    });
    report_rate(viewer.num_frames(), monotonic_seconds() - start);
  }
  ImGui_ImplGlfw_Shutdown();
}

int run(int argc, char** argv) {
  nao::CommandLine app("Shows the robot, its world and its messages in a window", "nao-viewer");
  CommonOptions common;
  ViewerOptions options;
  add_common_options(app, common);
  add_options(app, options);

  return run_program(app, common, argc, argv, [&] {
    options.robot = common.robot;
    options.validate();
    EventLoop loop;
    std::optional<Bus> bus;
    if (options.log_file.empty()) bus.emplace(common.lcm_url);
    const auto model = RobotModel::find(options.model);
    nao::logger::info("version {}, {}, robot {} from {}", version(),
                      bus ? "bus " + common.lcm_url : "log " + options.log_file, options.robot,
                      model.folder().string());
    Bus* bus_or_none = bus ? &*bus : nullptr;
    if (options.is_offscreen) {
      run_offscreen(loop, bus_or_none, model, options);
    } else {
      run_window(loop, bus_or_none, model, options);
    }
  });
}

}  // namespace
}  // namespace nao::viewer

int main(int argc, char** argv) {
  return nao::viewer::run(argc, argv);
}
