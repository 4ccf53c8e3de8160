#pragma once

#include <string>
#include <vector>

namespace nao::gateway {

/** A QR code: a square of dark and light modules, without its light border (quiet zone). */
struct QrCode {
  int width = 0;
  /** True where dark, (width * width), row-major. */
  std::vector<bool> is_dark;

  /** False outside. */
  bool at(int row, int column) const {
    return row >= 0 && column >= 0 && row < width && column < width &&
           is_dark[static_cast<size_t>(row) * static_cast<size_t>(width) +
                   static_cast<size_t>(column)];
  }
};

/** Encodes a text with error correction level M. @throws Error  if the text is too long (2331
 * bytes, ISO/IEC 18004, table 7). */
QrCode make_qr_code(const std::string& text);

/** Draws a code for a terminal, dark on light whatever its colors: two rows of modules in each line
 * of UTF-8 half blocks, with a border of two modules. */
std::string draw_on_terminal(const QrCode& code);

/** Draws a code as a gray-scale PNG file with the standard's border of four modules.
 * @param scale  Pixels per module. */
std::string draw_as_png(const QrCode& code, int scale);

}  // namespace nao::gateway
