#include "rendering/image.h"

#include <png.h>

#include <string>

#include "common/error.h"
#include "common/output_file.h"

namespace nao {

Image image_from_bgrx(int width, int height, const std::vector<uint8_t>& bgrx) {
  Image image{width, height, {}};
  image.rgb.reserve(static_cast<size_t>(3) * width * height);
  // From the last row in memory to the first: OpenGL's rows run bottom up, an image's top down.
  for (int v = height - 1; v >= 0; --v) {
    const uint8_t* row = &bgrx[static_cast<size_t>(4) * width * v];
    for (int u = 0; u < width; ++u) {
      for (const int channel : {2, 1, 0}) image.rgb.push_back(row[4 * u + channel]);
    }
  }
  return image;
}

Image downsampled(const Image& image, int factor) {
  if (factor < 1 || image.width % factor != 0 || image.height % factor != 0) {
    throw Error("an image of " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                " pixels cannot be reduced by the factor " + std::to_string(factor) +
                ": it must be positive and divide both sides");
  }
  Image small{image.width / factor, image.height / factor, {}};
  const int area = factor * factor;
  for (int v = 0; v < small.height; ++v) {
    for (int u = 0; u < small.width; ++u) {
      for (int channel = 0; channel < 3; ++channel) {
        int sum = area / 2;  // rounds the integer division to the nearest
        for (int i = 0; i < area; ++i) {
          sum += image.at(factor * u + i % factor, factor * v + i / factor)[channel];
        }
        small.rgb.push_back(static_cast<uint8_t>(sum / area));
      }
    }
  }
  return small;
}

void write_png(const std::filesystem::path& file, const Image& image) {
  // libpng's simplified interface: it owns what it allocates, even if it fails.
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = image.width;
  png.height = image.height;
  png.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0) {
    throw Error("cannot write " + file.string() + ": " + png.message);
  }
  bytes.resize(size);
  replace_file(file, bytes);
}

}  // namespace nao
