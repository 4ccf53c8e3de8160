#pragma once

struct GLFWwindow;

namespace nao::viewer {

/** Owner of ImGui's context. */
class ImGuiContextOwner {
 public:
  ImGuiContextOwner();
  ~ImGuiContextOwner();
  ImGuiContextOwner(const ImGuiContextOwner&) = delete;
  ImGuiContextOwner& operator=(const ImGuiContextOwner&) = delete;
};

/** A window with an OpenGL 3.3 context, which is current in the thread that created it. */
class Window {
 public:
  /** @param width, height  pixels. @throws Error  if there is no screen or no OpenGL 3.3. */
  Window(int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* get() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace nao::viewer
