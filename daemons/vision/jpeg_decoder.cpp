#include "daemons/vision/jpeg_decoder.h"

#include <turbojpeg.h>

#include <memory>

#include "common/error.h"

namespace nao::vision {
namespace {

/** The largest image of a NAO V5's cameras, pixels. */
constexpr int kMostImageWidth = 1280;
constexpr int kMostImageHeight = 960;
constexpr int kLeastImageWidth = 64;
constexpr int kLeastImageHeight = 48;

}  // namespace

// The size is checked before memory is taken: the header comes from outside.
std::string decode_jpeg(const uint8_t* data, size_t num_bytes, cv::Mat& bgr) {
  if (num_bytes == 0) return "the image is empty";
  // Each file gets its own decoder: after an error in a header, one would refuse all later files.
  const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
  if (decoder == nullptr) throw Error(std::string("libturbojpeg: ") + tjGetErrorStr2(nullptr));
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colorspace = 0;
  if (tjDecompressHeader3(decoder.get(), data, num_bytes, &width, &height, &subsampling,
                          &colorspace) != 0) {
    return std::string("no JPEG image: ") + tjGetErrorStr2(decoder.get());
  }
  if (width < kLeastImageWidth || width > kMostImageWidth || height < kLeastImageHeight ||
      height > kMostImageHeight) {
    return "the image has " + std::to_string(width) + "x" + std::to_string(height) +
           " pixels; from 64x48 to 1280x960 are allowed";
  }
  bgr.create(height, width, CV_8UC3);
  // A damaged image is rejected, not shown with grey parts; the limit of scans stops images that
  // would take minutes to decode.
  if (tjDecompress2(decoder.get(), data, num_bytes, bgr.data, width, static_cast<int>(bgr.step),
                    height, TJPF_BGR, TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS) != 0) {
    return std::string("damaged JPEG image: ") + tjGetErrorStr2(decoder.get());
  }
  return "";
}

}  // namespace nao::vision
