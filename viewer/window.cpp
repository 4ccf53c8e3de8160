#include "viewer/window.h"

// rendering/gl.h declares OpenGL's functions.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <string>

#include "common/error.h"

namespace nao::viewer {
namespace {

/** The last error of GLFW, which reports errors to a plain function. */
std::string& last_error() {
  static std::string text;
  return text;
}

[[noreturn]] void fail(const std::string& what) {
  const std::string why = last_error();
  glfwTerminate();
  throw Error(
      what + ": " + why +
      ". Is there a screen (DISPLAY)? Screenshots need none: --offscreen --screenshot FILE");
}

}  // namespace

ImGuiContextOwner::ImGuiContextOwner() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // no file in the current directory
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 4;
  // Opaque, so that the view need not be drawn behind them.
  for (const ImGuiCol color : {ImGuiCol_WindowBg, ImGuiCol_TitleBgCollapsed}) {
    ImGui::GetStyle().Colors[color].w = 1;
  }
}

ImGuiContextOwner::~ImGuiContextOwner() {
  ImGui::DestroyContext();
}

Window::Window(int width, int height) {
  glfwSetErrorCallback([](int, const char* text) { last_error() = text; });
  if (glfwInit() == GLFW_FALSE) fail("no window");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  window_ = glfwCreateWindow(width, height, "nao-viewer", nullptr, nullptr);
  if (window_ == nullptr) fail("no window with OpenGL 3.3");
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(0);  // the main loop has its own timer
}

Window::~Window() {
  if (window_ != nullptr) glfwDestroyWindow(window_);
  glfwTerminate();
}

}  // namespace nao::viewer
