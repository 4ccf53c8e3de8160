#include "tools/vision-train/patch_file.h"

#include "common/error.h"
#include "daemons/vision/patch_sampler.h"

namespace nao::vision {

PatchFile::PatchFile(const std::filesystem::path& file)
    : file_(file), stream_(file, std::ios::binary) {
  if (!stream_) throw Error("cannot write " + file.string());
}

void PatchFile::add(const cv::Mat& patch, const Numbers& numbers) {
  CV_Assert(patch.isContinuous() && patch.type() == CV_8UC3 &&
            patch.total() == PatchSampler::kSize * PatchSampler::kSize);
  stream_.write(reinterpret_cast<const char*>(patch.data),
                static_cast<std::streamsize>(patch.total() * patch.elemSize()));
  stream_.write(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
  ++num_records_;
}

void PatchFile::close() {
  if (!stream_.flush()) throw Error("cannot write " + file_.string());
}

}  // namespace nao::vision
