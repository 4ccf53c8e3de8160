#pragma once

#include <png.h>

#include <filesystem>

#include "common/error.h"
#include "rendering/image.h"

namespace nao {

/** @throws Error  if the file cannot be read. */
inline Image read_png(const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, file.c_str()) == 0) {
    throw Error("cannot read " + file.string() + ": " + png.message);
  }
  png.format = PNG_FORMAT_RGB;
  Image image;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.rgb.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr) == 0) {
    throw Error("cannot read " + file.string() + ": " + png.message);
  }
  return image;
}

}  // namespace nao
