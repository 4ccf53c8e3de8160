#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "phone-gateway/server/message_bytes.h"
#include "phone-gateway/server/request_check.h"

namespace nao {

/** A picture that came from the camera. */
struct StoredPicture {
  /** Robot time of the state that it shows, microseconds. */
  int64_t utime = 0;
  naoremote::Camera camera = naoremote::CAMERA_TOP;
  uint32_t width = 0;
  uint32_t height = 0;
  std::string jpeg;
  /** When it came, s, and its number: later pictures have greater ones. */
  double time = 0;
  uint64_t number = 0;
  /** The message that brings it to clients. */
  SharedEncoding encoding;
};

/** The newest picture of each camera and size. */
class PictureShelf {
 public:
  void put(StoredPicture picture, double now) {
    picture.time = now;
    picture.number = ++num_pictures_;
    auto& place = pictures_[{picture.camera, picture.width}];
    place = std::move(picture);
  }

  /** @return nullptr if there is none newer than number `after`. */
  StoredPicture* find(const PictureChoice& choice, uint64_t after) {
    const auto found = pictures_.find({choice.camera, choice.width});
    return found != pictures_.end() && found->second.number > after ? &found->second : nullptr;
  }

  /** Throws away what came before `time`: nobody has watched it since. */
  void drop_before(double time) {
    for (auto it = pictures_.begin(); it != pictures_.end();) {
      it = it->second.time < time ? pictures_.erase(it) : std::next(it);
    }
  }

 private:
  std::map<std::pair<naoremote::Camera, uint32_t>, StoredPicture> pictures_;
  uint64_t num_pictures_ = 0;
};

}  // namespace nao
