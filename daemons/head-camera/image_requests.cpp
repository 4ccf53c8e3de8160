#include "daemons/head-camera/image_requests.h"

#include <algorithm>

#include "robot_model/robot_model.h"

namespace nao::camera {
namespace {

/** Validity of a request, s; fixed by camera_command_t. */
constexpr double kValidity = 2.0;
/** Limit of stored requests, against a sender that changes its name with every message. Chosen: far
 * above the number of receivers on a bus. */
constexpr size_t kMaxEntries = 256;
/** Credit at which an image is due: 1, less the rounding error of sums such as 1/3 + 1/3 + 1/3. */
constexpr double kDue = 1 - 1e-6;
/** JPEG qualities above this give larger files without visible gain (libjpeg's documentation). */
constexpr int kMaxQuality = 95;

}  // namespace

std::string check_request(const ImageRequest& request, const std::vector<CameraModel>& cameras) {
  const auto has_its_name = [&](const CameraModel& c) { return c.name == request.camera; };
  if (std::none_of(cameras.begin(), cameras.end(), has_its_name)) {
    std::string names;
    for (const CameraModel& known : cameras) names += (names.empty() ? "" : ", ") + known.name;
    return "the robot has no camera \"" + request.camera + "\"; its cameras are: " + names;
  }
  if (request.width != kFullWidth && request.width != kFullWidth / 2 &&
      request.width != kFullWidth / 4) {
    return "the image width " + std::to_string(request.width) +
           " is not supported; use 640, 320 or 160";
  }
  if (!(request.rate >= 1 && request.rate <= kMaxRate)) {
    return "the image rate " + std::to_string(request.rate) + " is outside 1 to 30 a second";
  }
  if (request.quality < 0 || request.quality > kMaxQuality) {
    return "the JPEG quality " + std::to_string(request.quality) + " is outside 1 to 95";
  }
  return "";
}

// A sender's request for one camera and width replaces its earlier one and restarts its validity.
void ImageRequests::add(const std::string& source, const ImageRequest& request, double now) {
  const auto key = std::make_tuple(source, request.camera, request.width);
  if (entries_.size() >= kMaxEntries && entries_.count(key) == 0) return;
  entries_[key] = {request, now + kValidity};
}

std::vector<ImageRequest> ImageRequests::merged(double now) {
  // Requests that were not repeated expire; a receiver need not announce its end.
  std::erase_if(entries_, [now](const auto& entry) { return entry.second.end < now; });
  // The widest image of a camera first: a receiver that takes the first one gets the best.
  std::map<std::pair<std::string, int>, ImageRequest> merged;
  for (const auto& [key, entry] : entries_) {
    const auto [place, is_new] =
        merged.try_emplace({entry.request.camera, -entry.request.width}, entry.request);
    if (is_new) continue;
    // Receivers of one size share its images: the fastest rate and the best quality serve all.
    place->second.rate = std::max(place->second.rate, entry.request.rate);
    place->second.quality = std::max(place->second.quality, entry.request.quality);
  }
  std::vector<ImageRequest> requests;
  requests.reserve(merged.size());
  for (const auto& [key, request] : merged) requests.push_back(request);
  return requests;
}

// Called at kMaxRate. Each call adds rate / kMaxRate to the credit, and an image costs 1: the mean
// rate is exact, and images are spread evenly.
std::vector<ImageRequest> ImageSchedule::due(const std::vector<ImageRequest>& requests) {
  // Only the credit of the current requests is kept.
  std::map<std::pair<std::string, int>, double> credit;
  std::vector<ImageRequest> due;
  for (const ImageRequest& request : requests) {
    const auto key = std::make_pair(request.camera, request.width);
    const auto known = credit_.find(key);
    double value = known != credit_.end() ? known->second + request.rate / kMaxRate : 1;
    if (value >= kDue) {
      due.push_back(request);
      value -= 1;
    }
    credit[key] = value;
  }
  credit_ = std::move(credit);
  return due;
}

}  // namespace nao::camera
