#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nao::camera {

/** Converts an image from YUYV, as cameras deliver it, to the pixels of a CameraFrame.
 * @param yuyv  2 bytes a pixel, rows from the top down: Y, Cb, Y, Cr of each two pixels.
 * @param width  Even, pixels. @param height  Pixels.
 * @param bgrx  Resized to hold the result: rows from the bottom up, blue, green, red, 255.
 *
 * Equations: ITU-T T.871 (JFIF), full range, as B-Human and NaoTH read these cameras. */
void yuyv_to_bgrx(std::span<const uint8_t> yuyv, int width, int height, std::vector<uint8_t>& bgrx);

/** The reverse; the colors of two neighbors are averaged.
 * @param yuyv  Of 2 width height bytes, filled. */
void bgrx_to_yuyv(const std::vector<uint8_t>& bgrx, int width, int height, std::span<uint8_t> yuyv);

}  // namespace nao::camera
