#include "rendering/picture.h"

#include <png.h>

#include <string>

#include "common/error.h"

namespace nao {

Picture picture_from_bgrx(int width, int height, const std::vector<uint8_t>& bgrx) {
  Picture picture{width, height, {}};
  picture.rgb.reserve(static_cast<size_t>(3) * width * height);
  for (int v = height - 1; v >= 0; --v) {
    const uint8_t* row = &bgrx[static_cast<size_t>(4) * width * v];
    for (int u = 0; u < width; ++u) {
      for (const int channel : {2, 1, 0}) picture.rgb.push_back(row[4 * u + channel]);
    }
  }
  return picture;
}

Picture shrunk(const Picture& picture, int factor) {
  if (factor < 1 || picture.width % factor != 0 || picture.height % factor != 0) {
    throw Error("a picture's size must be a multiple of the factor that it shrinks by");
  }
  Picture small{picture.width / factor, picture.height / factor, {}};
  const int area = factor * factor;
  for (int v = 0; v < small.height; ++v) {
    for (int u = 0; u < small.width; ++u) {
      for (int channel = 0; channel < 3; ++channel) {
        int sum = area / 2;
        for (int i = 0; i < area; ++i) {
          sum += picture.at(factor * u + i % factor, factor * v + i / factor)[channel];
        }
        small.rgb.push_back(static_cast<uint8_t>(sum / area));
      }
    }
  }
  return small;
}

void write_png(const std::filesystem::path& file, const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = picture.width;
  image.height = picture.height;
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, file.c_str(), 0, picture.rgb.data(), 0, nullptr) == 0) {
    throw Error("cannot write " + file.string() + ": " + image.message);
  }
}

Picture read_png(const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0) {
    throw Error("cannot read " + file.string() + ": " + image.message);
  }
  image.format = PNG_FORMAT_RGB;
  Picture picture;
  picture.width = static_cast<int>(image.width);
  picture.height = static_cast<int>(image.height);
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) == 0) {
    throw Error("cannot read " + file.string() + ": " + image.message);
  }
  return picture;
}

}  // namespace nao
