#include "rendering/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "common/error.h"

namespace nao {
namespace {

std::string failure(const char* function) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%s failed (EGL error 0x%04x)", function, eglGetError());
  return text.data();
}

bool has_extension(const char* extensions, const char* name) {
  if (extensions == nullptr) return false;
  // The name is searched with spaces around it: one extension's name may be the beginning of
  // another's.
  const std::string padded = std::string(" ") + extensions + " ";
  return padded.find(std::string(" ") + name + " ") != std::string::npos;
}

// Extension functions are not exported by the library: they are looked up at run time.
template <class Function>
Function find(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/** Displays of graphics cards, without software renderers, which the surfaceless platform has. */
std::vector<EGLDisplay> device_displays() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto query_devices = find<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_string = find<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  const auto get_display = find<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (!has_extension(client, "EGL_EXT_platform_device") || query_devices == nullptr ||
      query_string == nullptr || get_display == nullptr) {
    return {};
  }
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint num_devices = 0;
  if (query_devices(devices.size(), devices.data(), &num_devices) == EGL_FALSE) return {};
  std::vector<EGLDisplay> displays;
  for (EGLint i = 0; i < num_devices; ++i) {
    if (has_extension(query_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software")) {
      continue;
    }
    displays.push_back(get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
  }
  return displays;
}

EGLDisplay surfaceless_display() {
  const auto get_display = find<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (get_display == nullptr || !has_extension(client, "EGL_MESA_platform_surfaceless")) {
    return EGL_NO_DISPLAY;
  }
  return get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

}  // namespace

std::vector<EglContext::Candidate> EglContext::candidates(Platform platform) {
  std::vector<Candidate> found;
  // In the order of preference: a graphics card, software without a screen, the system's default.
  const bool any = platform == Platform::kAuto;
  if (any || platform == Platform::kDevice) {
    for (const EGLDisplay display : device_displays()) found.push_back({"device", display});
  }
  if (any || platform == Platform::kSurfaceless) {
    found.push_back({"surfaceless", surfaceless_display()});
  }
  if (any || platform == Platform::kDefault) {
    found.push_back({"default display", eglGetDisplay(EGL_DEFAULT_DISPLAY)});
  }
  return found;
}

// Returns why this display cannot be used, or an empty text after it has become current.
std::string EglContext::open(void* display) {
  if (display == EGL_NO_DISPLAY) return "not supported by this EGL";
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) return failure("eglInitialize");
  // A display that was initialized must be terminated on every exit path.
  const auto give_up = [display](const std::string& why) {
    eglTerminate(display);
    return why;
  };
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!has_extension(extensions, "EGL_KHR_surfaceless_context")) {
    return give_up("does not support contexts without a surface");
  }
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return give_up(failure("eglBindAPI"));
  // All drawing goes to framebuffer objects, so no configuration is needed if EGL allows that.
  EGLConfig config = nullptr;
  if (!has_extension(extensions, "EGL_KHR_no_config_context")) {
    constexpr std::array<EGLint, 3> kAttributes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint num_configs = 0;
    if (eglChooseConfig(display, kAttributes.data(), &config, 1, &num_configs) == EGL_FALSE ||
        num_configs == 0) {
      return give_up(failure("eglChooseConfig"));
    }
  }
  constexpr std::array<EGLint, 7> kVersion{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, kVersion.data());
  if (context == EGL_NO_CONTEXT) return give_up(failure("eglCreateContext (OpenGL 3.3 core)"));
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
    const std::string why = failure("eglMakeCurrent");
    eglDestroyContext(display, context);
    return give_up(why);
  }
  display_ = display;
  context_ = context;
  return "";
}

EglContext::EglContext(Platform platform) {
  // llvmpipe's worker threads: none, unless the environment says otherwise (the last argument keeps
  // an existing value).
  setenv("LP_NUM_THREADS", "0", 0);
  // The first candidate that opens is taken; the error lists all with their reasons.
  std::string tried;
  for (const Candidate& candidate : candidates(platform)) {
    const std::string why = open(candidate.display);
    if (why.empty()) {
      platform_name_ = candidate.name;
      return;
    }
    tried += "; " + candidate.name + ": " + why;
  }
  throw Error("no OpenGL without a screen" + (tried.empty() ? ": no such device" : tried) +
              ". Install Debian's packages libegl-mesa0 and libgl1-mesa-dri: their driver needs no "
              "graphics card");
}

EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

EglContext::Platform egl_platform(const std::string& name) {
  if (name == "auto") return EglContext::Platform::kAuto;
  if (name == "device") return EglContext::Platform::kDevice;
  if (name == "surfaceless") return EglContext::Platform::kSurfaceless;
  if (name == "default") return EglContext::Platform::kDefault;
  throw ConfigError("unknown EGL platform \"" + name +
                    "\"; use auto, device, surfaceless or default");
}

}  // namespace nao
