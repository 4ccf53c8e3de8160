#pragma once

#include <cstdint>
#include <vector>

namespace nao {

/** A JPEG picture in the graphics card's memory, for showing it in a panel. */
class PictureTexture {
 public:
  PictureTexture();
  ~PictureTexture();
  PictureTexture(const PictureTexture&) = delete;
  PictureTexture& operator=(const PictureTexture&) = delete;

  /** Replaces the picture. @return false, keeping the old one, if the file is damaged. */
  bool load_jpeg(const std::vector<uint8_t>& file);

  /** OpenGL's number; 0 until a picture is loaded. */
  unsigned texture() const { return width_ > 0 ? texture_ : 0; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void* decoder_;
  unsigned texture_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<uint8_t> pixels_;
};

}  // namespace nao
