#include "viewer/image_texture.h"

#include <turbojpeg.h>

#include <memory>

#include "common/error.h"
#include "rendering/gl.h"

namespace nao::viewer {
namespace {

/** Largest side of an image, pixels, against damaged files. Chosen: above every camera's. */
constexpr int kMaxSize = 4096;

}  // namespace

ImageTexture::ImageTexture() {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

ImageTexture::~ImageTexture() {
  glDeleteTextures(1, &texture_);
}

bool ImageTexture::load_jpeg(const std::vector<uint8_t>& file) {
  // Each file gets its own decoder: after an error in a header, one would refuse all later files.
  const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
  if (decoder == nullptr) throw Error("libturbojpeg cannot decompress");
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colors = 0;
  if (tjDecompressHeader3(decoder.get(), file.data(), file.size(), &width, &height, &subsampling,
                          &colors) != 0 ||
      width < 1 || height < 1 || width > kMaxSize || height > kMaxSize) {
    return false;
  }
  pixels_.resize(static_cast<size_t>(4) * width * height);
  if (tjDecompress2(decoder.get(), file.data(), file.size(), pixels_.data(), width, 0, height,
                    TJPF_RGBX, 0) != 0) {
    return false;
  }
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               pixels_.data());
  width_ = width;
  height_ = height;
  return true;
}

}  // namespace nao::viewer
