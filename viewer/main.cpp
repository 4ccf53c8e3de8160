// OpenGL's functions come from scene/gl_objects.h.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <optional>
#include <string>

#include "backends/imgui_impl_glfw.h"
#include "common/bus.h"
#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "rendering/egl_context.h"
#include "rendering/gl_objects.h"
#include "rendering/picture.h"
#include "robot_model/robot_model.h"
#include "viewer/viewer.h"
#include "viewer/viewer_options.h"

namespace {

using nao::ViewerOptions;

/** Frames a second: enough for eyes, and the simulator needs the processor too. */
constexpr double kRate = 30;

void add_options(nao::CommandLine& app, ViewerOptions& options) {
  app.add_option("--log", options.log_file, "Log of lcm-logger to play instead of the bus")
      ->existing_file();
  app.add_option("--log-start", options.log_start, "Where to start in the log, s")->show_default();
  app.add_flag("--paused", options.is_paused, "Stand still in the log");
  app.add_option("--screenshot", options.screenshot, "Write a PNG file after --frames, then end");
  app.add_option("--frames", options.num_frames, "Frames before the screenshot, 30 a second")
      ->show_default();
  app.add_flag("--offscreen", options.is_offscreen, "Draw the screenshot without window or screen");
  app.add_flag("--no-panels", options.without_panels, "Show the world alone");
  app.add_option("--supersample", options.supersample,
                 "With --offscreen --no-panels: draw this many times finer, then average")
      ->show_default();
  app.add_option("--width", options.width, "Width, pixels")->show_default();
  app.add_option("--height", options.height, "Height, pixels")->show_default();
  app.add_option("--shadow-size", options.shadow_size, "Side of the shadow map, texels; 0: none")
      ->show_default();
  app.add_option("--view", options.view,
                 "Camera: azimuth and elevation (degrees), distance (m), and x, y, z of what it "
                 "looks at (m)")
      ->separated_by(',');
  app.add_option("--plot", options.plots, "Curve to begin with: CHANNEL:FIELD; may be repeated");
  app.add_option("--posture", options.waiting_posture, "Posture shown until a robot is heard of")
      ->show_default();
  app.add_flag("!--no-follow", options.follow, "Leave the camera where it is");
  app.add_flag("--no-marks", options.without_marks,
               "Show robots and ball alone, no forces or feet");
  app.add_flag("--see-through", options.see_through, "Draw the robot translucent");
}

/** ImGui's own state, as long as the viewer lives. */
class ImGuiContextOwner {
 public:
  ImGuiContextOwner() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // nothing is written to where the program happens to run
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 4;
    // Opaque: what they hide need not be drawn.
    for (const ImGuiCol color : {ImGuiCol_WindowBg, ImGuiCol_TitleBgCollapsed}) {
      ImGui::GetStyle().Colors[color].w = 1;
    }
  }
  ~ImGuiContextOwner() { ImGui::DestroyContext(); }
  ImGuiContextOwner(const ImGuiContextOwner&) = delete;
  ImGuiContextOwner& operator=(const ImGuiContextOwner&) = delete;
};

/** A window with an OpenGL 3.3 context. */
class Window {
 public:
  Window(int width, int height) {
    glfwSetErrorCallback([](int, const char* text) { last_error() = text; });
    if (glfwInit() == GLFW_FALSE) fail("no window");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    window_ = glfwCreateWindow(width, height, "nao-viewer", nullptr, nullptr);
    if (window_ == nullptr) fail("no window with OpenGL 3.3");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(0);  // the main loop keeps the time
  }
  ~Window() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* get() const { return window_; }

 private:
  /** GLFW tells errors through a plain function, so its last words need a place of their own. */
  static std::string& last_error() {
    static std::string text;
    return text;
  }
  [[noreturn]] static void fail(const std::string& what) {
    const std::string why = last_error();
    glfwTerminate();
    throw nao::Error(what + ": " + why +
                     ". Is there a screen (DISPLAY)? Pictures need none: --offscreen --screenshot "
                     "FILE");
  }

  GLFWwindow* window_ = nullptr;
};

void save(const ViewerOptions& options, unsigned framebuffer, int width, int height) {
  std::vector<uint8_t> pixels(static_cast<size_t>(4) * width * height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_BGRA, GL_UNSIGNED_BYTE, pixels.data());
  nao::write_png(options.screenshot,
                 nao::shrunk(nao::picture_from_bgrx(width, height, pixels), options.supersample));
  spdlog::info("wrote {}", options.screenshot);
}

/** Calls `draw(now)` at the frame rate, and handles messages between, until it returns false. */
void run_loop(nao::EventLoop& loop, nao::Bus* bus, const std::function<bool(double)>& draw) {
  if (bus != nullptr) loop.on_readable(bus->descriptor(), [bus] { bus->handle(); });
  loop.every(1 / kRate, [&] {
    if (!draw(nao::monotonic_seconds())) loop.stop("done");
  });
  const double start = nao::monotonic_seconds();
  const std::string reason = loop.run();
  spdlog::info("{} after {:.1f} s", reason, nao::monotonic_seconds() - start);
}

void report_rate(int64_t num_frames, double seconds) {
  if (seconds > 0) {
    spdlog::info("{} frames, {:.1f} a second", num_frames,
                 static_cast<double>(num_frames) / seconds);
  }
}

void run_offscreen(nao::EventLoop& loop, nao::Bus* bus, const nao::RobotModel& model,
                   const ViewerOptions& options) {
  const nao::EglContext context;
  spdlog::info("drawing with {}", nao::SceneRenderer::driver());
  const ImGuiContextOwner imgui;
  const int width = options.width * options.supersample;
  const int height = options.height * options.supersample;
  const nao::gl::Framebuffer framebuffer(width, height);
  nao::Viewer viewer(model, bus, options);
  ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  const double start = nao::monotonic_seconds();
  run_loop(loop, bus, [&](double now) {
    ImGui::GetIO().DeltaTime = static_cast<float>(1 / kRate);
    viewer.draw(framebuffer.id(), width, height, now);
    if (viewer.num_frames() < options.num_frames) return true;
    save(options, framebuffer.id(), width, height);
    return false;
  });
  report_rate(viewer.num_frames(), nao::monotonic_seconds() - start);
}

void run_window(nao::EventLoop& loop, nao::Bus* bus, const nao::RobotModel& model,
                const ViewerOptions& options) {
  const Window window(options.width, options.height);
  spdlog::info("drawing with {}", nao::SceneRenderer::driver());
  const ImGuiContextOwner imgui;
  ImGui_ImplGlfw_InitForOpenGL(window.get(), true);
  {
    nao::Viewer viewer(model, bus, options);
    const double start = nao::monotonic_seconds();
    run_loop(loop, bus, [&](double now) {
      glfwPollEvents();
      if (glfwWindowShouldClose(window.get()) != 0) return false;
      int width = 0;
      int height = 0;
      glfwGetFramebufferSize(window.get(), &width, &height);
      if (width < 1 || height < 1) return true;  // folded away
      ImGui_ImplGlfw_NewFrame();
      viewer.draw(0, width, height, now);
      const bool is_last = !options.screenshot.empty() && viewer.num_frames() >= options.num_frames;
      if (is_last) save(options, 0, width, height);
      glfwSwapBuffers(window.get());
      return !is_last;
    });
    report_rate(viewer.num_frames(), nao::monotonic_seconds() - start);
  }
  ImGui_ImplGlfw_Shutdown();
}

}  // namespace

int main(int argc, char** argv) {
  nao::CommandLine app("Shows the robot, its world and its messages in a window", "nao-viewer");
  nao::CommonOptions common;
  ViewerOptions options;
  nao::add_common_options(app, common);
  add_options(app, options);

  return nao::run_program(app, common, argc, argv, [&] {
    options.robot = common.robot;
    options.validate();
    nao::EventLoop loop;
    std::optional<nao::Bus> bus;
    if (options.log_file.empty()) bus.emplace(common.lcm_url);
    const auto model = nao::RobotModel::load(nao::data_path() / "robots" / "nao");
    spdlog::info("version {}, {}, robot {} from {}", nao::version(),
                 bus ? "bus " + common.lcm_url : "log " + options.log_file, options.robot,
                 model.folder().string());
    nao::Bus* bus_or_none = bus ? &*bus : nullptr;
    if (options.is_offscreen) {
      run_offscreen(loop, bus_or_none, model, options);
    } else {
      run_window(loop, bus_or_none, model, options);
    }
  });
}
