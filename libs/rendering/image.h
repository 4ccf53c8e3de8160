#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace nao {

/** Pixels of an image: rows from the top down, 3 bytes a pixel (red, green, blue). */
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;

  const uint8_t* at(int u, int v) const { return &rgb[3 * (static_cast<size_t>(v) * width + u)]; }
};

/** Converts what gl::Framebuffer::read() gives: rows from the bottom up, 4 bytes a pixel (blue,
 * green, red, 255). */
Image image_from_bgrx(int width, int height, const std::vector<uint8_t>& bgrx);

/** Reduces the resolution: each pixel becomes the rounded mean of a square of `factor` x `factor`
 * pixels.
 * @param factor  Must divide width and height. @throws Error  if it does not. */
Image downsampled(const Image& image, int factor);

/** @throws Error  if the file cannot be written. */
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace nao
