#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "daemons/head-camera/head_camera.h"

namespace nao {
class EventLoop;
}

namespace nao::camera {

/** Where the images of the head cameras come from: a renderer, or cameras. */
class ImageSource {
 public:
  ImageSource() = default;
  virtual ~ImageSource() = default;
  ImageSource(const ImageSource&) = delete;
  ImageSource& operator=(const ImageSource&) = delete;

  /** Registers with the loop what the source waits for. @param on_image  Called with a camera's
   * name whenever its image can be taken. */
  virtual void attach(EventLoop& loop, std::function<void(const std::string&)> on_image) = 0;
  /** Whether a client needs images: a source may sleep meanwhile. */
  virtual void set_needed(bool /*is_needed*/) {}
  /** Names and fields of view of the cameras that it has images of. */
  virtual std::vector<CameraModel> cameras() const = 0;
  /** Why no camera has an image, in words; empty if one has. @param now  s, monotonic. */
  virtual std::string missing_input(double now) const = 0;
  /** Whether take() has an image of this camera that is not outdated. @param now  s, monotonic. */
  virtual bool has_image(const std::string& camera, double now) const = 0;
  /** Robot time of what take() would show, microseconds. */
  virtual int64_t utime(const std::string& camera) const = 0;
  /** The newest image. @param min_width  Sizes below this width are not computed.
   * @return Valid until the next call. @throws Error  if has_image() is false. */
  virtual const CameraFrame& take(const std::string& camera, int min_width) = 0;
  /** Problems since the last call, one sentence each. */
  virtual std::vector<std::string> take_problems() = 0;
  /** Description of the source, for the log. */
  virtual std::string description() const = 0;
};

}  // namespace nao::camera
