#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "phone-gateway/server/message_bytes.h"
#include "phone-gateway/server/request_check.h"

namespace nao {

/** A image that came from the camera. */
struct StoredImage {
  /** Robot time of the state that it shows, microseconds. */
  int64_t utime = 0;
  std::string camera;
  uint32_t width = 0;
  uint32_t height = 0;
  std::string jpeg;
  /** When it came, s, and its number: later images have greater ones. */
  double time = 0;
  uint64_t number = 0;
  /** The message that brings it to clients. */
  SharedEncoding encoding;
};

/** The newest image of each camera and size. */
class ImageCache {
 public:
  void put(StoredImage image, double now) {
    image.time = now;
    image.number = ++num_images_;
    auto& place = images_[{image.camera, image.width}];
    place = std::move(image);
  }

  /** @return nullptr if there is none newer than number `after`. */
  StoredImage* find(const ImageSelection& choice, uint64_t after) {
    const auto found = images_.find({choice.camera, choice.width});
    return found != images_.end() && found->second.number > after ? &found->second : nullptr;
  }

  /** Throws away what came before `time`: nobody has watched it since. */
  void drop_before(double time) {
    for (auto it = images_.begin(); it != images_.end();) {
      it = it->second.time < time ? images_.erase(it) : std::next(it);
    }
  }

 private:
  std::map<std::pair<std::string, uint32_t>, StoredImage> images_;
  uint64_t num_images_ = 0;
};

}  // namespace nao
