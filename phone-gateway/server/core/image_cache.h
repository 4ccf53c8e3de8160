#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "phone-gateway/server/core/message_bytes.h"
#include "phone-gateway/server/core/request_check.h"

namespace nao::gateway {

/** An image received from the camera. */
struct CachedImage {
  /** Robot time at mid exposure, microseconds. */
  int64_t utime = 0;
  std::string camera;
  /** Pixels. */
  uint32_t width = 0;
  uint32_t height = 0;
  std::string jpeg;
  /** When it was received, s, and its number: later images have greater ones. */
  double received_at = 0;
  uint64_t number = 0;
  /** The message that carries it to clients. */
  SharedEncoding encoding;
};

/** The newest image of each camera and width. */
class ImageCache {
 public:
  void put(CachedImage image, double now) {
    image.received_at = now;
    image.number = ++num_images_;
    auto& entry = images_[{image.camera, image.width}];
    entry = std::move(image);
  }

  /** @return nullptr if there is none with a number greater than `after`. */
  CachedImage* find(const ImageSelection& selection, uint64_t after) {
    const auto found = images_.find({selection.camera, selection.width});
    return found != images_.end() && found->second.number > after ? &found->second : nullptr;
  }

  /** Drops the images received before `time`, s: the camera no longer sends this size. */
  void drop_before(double time) {
    for (auto it = images_.begin(); it != images_.end();) {
      it = it->second.received_at < time ? images_.erase(it) : std::next(it);
    }
  }

 private:
  std::map<std::pair<std::string, uint32_t>, CachedImage> images_;
  uint64_t num_images_ = 0;
};

}  // namespace nao::gateway
