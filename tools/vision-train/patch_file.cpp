#include "tools/vision-train/patch_file.h"

#include "daemons/vision/patch_sampler.h"

namespace nao::vision {

void PatchFile::add(const cv::Mat& patch, const Numbers& numbers) {
  CV_Assert(patch.isContinuous() && patch.type() == CV_8UC3 &&
            patch.total() == PatchSampler::kSize * PatchSampler::kSize);
  std::ostream& stream = file_.stream();
  stream.write(reinterpret_cast<const char*>(patch.data),
               static_cast<std::streamsize>(patch.total() * patch.elemSize()));
  stream.write(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
  ++num_records_;
}

}  // namespace nao::vision
