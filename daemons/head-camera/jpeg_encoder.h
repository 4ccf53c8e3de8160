#pragma once

#include <cstdint>
#include <vector>

namespace nao {

/** Compresses pictures to JPEG, each below a given size. */
class JpegEncoder {
 public:
  /** @throws Error  if the library refuses. */
  JpegEncoder();
  ~JpegEncoder();
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  /** Compresses with the wished quality, or the best below it that keeps the file small enough.
   * @param bgrx  As gl::Framebuffer::read() gives it: rows from the bottom up, 4 bytes a pixel.
   * @param quality  1 to 95.
   * @param most_bytes  Greatest size of the file.
   * @throws Error  if the library refuses, or no quality makes the file small enough. */
  std::vector<uint8_t> encode(const std::vector<uint8_t>& bgrx, int width, int height, int quality,
                              int most_bytes);

 private:
  void* handle_;
  unsigned char* buffer_ = nullptr;
  unsigned long buffer_bytes_ = 0;
};

}  // namespace nao
