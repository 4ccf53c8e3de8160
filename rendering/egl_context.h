#pragma once

#include <string>
#include <vector>

namespace nao {

/** An OpenGL 3.3 context without window or screen, current in the thread that made it. */
class EglContext {
 public:
  /** Ways to reach a driver: a graphics card, Mesa without a surface, the system's default. */
  enum class Platform { kAuto, kDevice, kSurfaceless, kDefault };

  /** Opens the first that works of: graphics cards, Mesa without a surface (a card's driver or
   * llvmpipe), the default display; or only the one given.
   * Sets LP_NUM_THREADS=0 unless the environment says otherwise: llvmpipe then draws in this
   * thread, leaves the other cores to the simulator and gives the same picture every time.
   * @throws Error  if none works; says what was tried and why each failed. */
  explicit EglContext(Platform platform = Platform::kAuto);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /** Which way was taken, for the log: "surfaceless". */
  const std::string& platform_name() const { return platform_name_; }

 private:
  struct Candidate {
    std::string name;
    void* display;
  };

  static std::vector<Candidate> candidates(Platform platform);
  /** @return Why it failed, empty if the context is now current. */
  std::string open(void* display);

  std::string platform_name_;
  void* display_ = nullptr;
  void* context_ = nullptr;
};

/** "auto", "device", "surfaceless" or "default". @throws ConfigError  for another name. */
EglContext::Platform egl_platform(const std::string& name);

}  // namespace nao
