#pragma once

#include <cstdint>
#include <vector>

namespace nao::viewer {

/** A JPEG image in the graphics card's memory, for showing it in a panel. */
class ImageTexture {
 public:
  ImageTexture();
  ~ImageTexture();
  ImageTexture(const ImageTexture&) = delete;
  ImageTexture& operator=(const ImageTexture&) = delete;

  /** Replaces the image. @return false if the file is damaged; the previous image then stays.
   * @throws Error  if libturbojpeg cannot be initialized. */
  bool load_jpeg(const std::vector<uint8_t>& file);

  /** OpenGL's number; 0 before an image is loaded. */
  unsigned texture() const { return width_ > 0 ? texture_ : 0; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  unsigned texture_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<uint8_t> pixels_;
};

}  // namespace nao::viewer
