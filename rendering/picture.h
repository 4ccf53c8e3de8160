#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace nao {

/** Pixels of a picture: rows from the top down, 3 bytes a pixel (red, green, blue). */
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;

  const uint8_t* at(int u, int v) const { return &rgb[3 * (static_cast<size_t>(v) * width + u)]; }
};

/** From what gl::Framebuffer::read() gives: rows from the bottom up, blue, green, red, 255. */
Picture picture_from_bgrx(int width, int height, const std::vector<uint8_t>& bgrx);

/** Halves a picture `factor` times finer than wanted: each pixel becomes the mean of a square.
 * @param factor  Divides width and height. */
Picture shrunk(const Picture& picture, int factor);

/** @throws Error  if the file cannot be written. */
void write_png(const std::filesystem::path& file, const Picture& picture);

/** @throws Error  if the file cannot be read. */
Picture read_png(const std::filesystem::path& file);

}  // namespace nao
