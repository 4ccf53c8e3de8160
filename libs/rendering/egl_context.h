#pragma once

#include <string>
#include <vector>

namespace nao {

/** An OpenGL 3.3 context without window or screen, current in the thread that created it. */
class EglContext {
 public:
  /** EGL platforms: graphics cards, Mesa without a surface, the system's default display; kAuto
   * tries them in this order. */
  enum class Platform { kAuto, kDevice, kSurfaceless, kDefault };

  /** Opens a context on the given platform.
   * Sets LP_NUM_THREADS=0 unless the environment sets it: Mesa's software renderer llvmpipe then
   * draws in this thread, leaves the other cores to the simulator, and is deterministic.
   * @throws Error  if no platform works; says which were tried and why each failed. */
  explicit EglContext(Platform platform = Platform::kAuto);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /** The platform that is used, for the log: "surfaceless". */
  const std::string& platform_name() const { return platform_name_; }

 private:
  struct Candidate {
    std::string name;
    void* display;
  };

  static std::vector<Candidate> candidates(Platform platform);
  /** @return Reason of the failure; empty if the context is now current. */
  std::string open(void* display);

  std::string platform_name_;
  void* display_ = nullptr;
  void* context_ = nullptr;
};

/** "auto", "device", "surfaceless" or "default". @throws ConfigError  for another name. */
EglContext::Platform egl_platform(const std::string& name);

}  // namespace nao
