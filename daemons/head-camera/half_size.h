#pragma once

#include <cstdint>
#include <vector>

namespace nao::camera {

/** Halves both sides of an image: each pixel becomes the rounded mean of four.
 * @param pixels  4 bytes a pixel, row by row. @param width, height  Even, pixels.
 * @param half  Resized to hold the result. */
void halve(const std::vector<uint8_t>& pixels, int width, int height, std::vector<uint8_t>& half);

}  // namespace nao::camera
