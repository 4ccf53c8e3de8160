#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nao {

/** A QR code: a square of dark and light modules, without the light border that it needs. */
struct QrCode {
  int width = 0;
  /** True where dark, (width * width), row by row. */
  std::vector<bool> is_dark;

  /** False outside. */
  bool at(int row, int column) const {
    return row >= 0 && column >= 0 && row < width && column < width &&
           is_dark[static_cast<size_t>(row) * static_cast<size_t>(width) +
                   static_cast<size_t>(column)];
  }
};

/** @throws Error  if the text is too long, above some 2000 characters. */
QrCode make_qr_code(const std::string& text);

/** For a terminal, dark on light whatever its colours: two rows of modules in each line, made of
 * half blocks in UTF-8, with a border of two modules. */
std::string draw_on_terminal(const QrCode& code);

/** As a PNG file, grey, with the border of four modules of the standard. @param scale  Pixels per
 * module. */
std::string draw_as_png(const QrCode& code, int scale);

}  // namespace nao
