#include "phone-gateway/server/pairing/qr_code.h"

#include <qrencode.h>
#include <zlib.h>

#include <memory>

#include "common/error.h"

namespace nao::gateway {
namespace {

/** Modules. Half of the standard's, to save lines; phones read it against a dark terminal. */
constexpr int kTerminalBorder = 2;
/** Modules. ISO/IEC 18004, 9.1: quiet zone. */
constexpr int kPngBorder = 4;

void append_big_endian(std::string& bytes, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<char>((value >> shift) & 0xff));
  }
}

/** PNG specification, 5.3: length, type, data, CRC of type and data. */
void append_chunk(std::string& png, const std::string& type, const std::string& data) {
  append_big_endian(png, static_cast<uint32_t>(data.size()));
  const std::string checked = type + data;
  png += checked;
  append_big_endian(png,
                    static_cast<uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                                                static_cast<uInt>(checked.size()))));
}

std::string deflate_all(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string compressed(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(compressed.data()), &size,
               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != Z_OK) {
    throw Error("cannot compress: zlib failed");
  }
  compressed.resize(size);
  return compressed;
}

}  // namespace

QrCode make_qr_code(const std::string& text) {
  // Version 0: the smallest that holds the text. Level M corrects 15 % of the codewords.
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> encoded(
      QRcode_encodeString(text.c_str(), 0, QR_ECLEVEL_M, QR_MODE_8, 1), QRcode_free);
  if (!encoded) throw Error("the text is too long for a QR code: " + text);
  QrCode code;
  code.width = encoded->width;
  for (int i = 0; i < code.width * code.width; ++i) {
    code.is_dark.push_back((encoded->data[i] & 1) != 0);
  }
  return code;
}

// Two rows of modules in one line of text, by half blocks.
std::string draw_on_terminal(const QrCode& code) {
  std::string text;
  for (int row = -kTerminalBorder; row < code.width + kTerminalBorder; row += 2) {
    text += "\x1b[40;97m";  // light modules are drawn in white on black
    for (int column = -kTerminalBorder; column < code.width + kTerminalBorder; ++column) {
      const bool is_upper_light = !code.at(row, column);
      const bool is_lower_light = !code.at(row + 1, column);
      text += is_upper_light ? (is_lower_light ? "\u2588" : "\u2580")
                             : (is_lower_light ? "\u2584" : " ");
    }
    text += "\x1b[0m\n";
  }
  return text;
}

std::string draw_as_png(const QrCode& code, int scale) {
  const int width = (code.width + 2 * kPngBorder) * scale;
  std::string rows;
  for (int y = 0; y < width; ++y) {
    rows.push_back('\0');  // filter type 0: none
    for (int x = 0; x < width; ++x) {
      rows.push_back(code.at(y / scale - kPngBorder, x / scale - kPngBorder) ? '\0' : '\xff');
    }
  }
  std::string header;
  append_big_endian(header, static_cast<uint32_t>(width));
  append_big_endian(header, static_cast<uint32_t>(width));
  header += std::string("\x08\0\0\0\0", 5);  // 8 bits, gray scale; compression, filter, interlace 0
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", deflate_all(rows));
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace nao::gateway
