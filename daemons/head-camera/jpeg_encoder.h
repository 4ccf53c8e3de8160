#pragma once

#include <cstdint>
#include <vector>

namespace nao::camera {

/** Compresses images to JPEG, each below a given size. */
class JpegEncoder {
 public:
  /** @throws Error  if libturbojpeg cannot be initialized. */
  JpegEncoder();
  ~JpegEncoder();
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  /** Compresses with the given quality; reduces it step by step while the file is too large.
   * @param bgrx  As gl::Framebuffer::read() gives it: rows from the bottom up, 4 bytes a pixel.
   * @param quality  1 to 95.
   * @param max_bytes  Limit of the size of the file.
   * @throws Error  if the size of `bgrx` is wrong, libturbojpeg fails, or the file exceeds the
   * limit with every quality. */
  std::vector<uint8_t> encode(const std::vector<uint8_t>& bgrx, int width, int height, int quality,
                              int max_bytes);

 private:
  void* handle_;
  unsigned char* buffer_ = nullptr;
  unsigned long buffer_bytes_ = 0;
};

}  // namespace nao::camera
