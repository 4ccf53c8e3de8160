#pragma once

#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace nao {
struct CameraModel;
}

namespace nao::camera {

/** A requested stream of images. */
struct ImageRequest {
  /** Camera name from the robot's description. */
  std::string camera;
  /** Pixels: 640, 320 or 160. */
  int width = 0;
  /** Images a second, 1 to 30. */
  double rate = 0;
  /** JPEG quality, 1 to 95; 0: the daemon's default. */
  int quality = 0;
};

/** Size of the rendered images, pixels; smaller ones are made from them. */
inline constexpr int kFullWidth = 640;
inline constexpr int kFullHeight = 480;
/** Highest rate, images a second. */
inline constexpr double kMaxRate = 30;

/** Checks a request.
 * @param cameras  Cameras of the robot. @return Why it cannot be served, a sentence; empty if it
 * can. */
std::string check_request(const ImageRequest& request, const std::vector<CameraModel>& cameras);

/** The valid requests of all receivers. A request is valid for 2 s after its last repetition. */
class ImageRequests {
 public:
  /** Adds or renews a request. @param source  The receiver. @param now  s, monotonic. */
  void add(const std::string& source, const ImageRequest& request, double now);

  /** The valid requests, merged: one for each camera and width, with the highest rate and quality.
   */
  std::vector<ImageRequest> merged(double now);

 private:
  struct Entry {
    ImageRequest request;
    /** End of validity, s. */
    double end;
  };
  /** Requests by source, camera and width. */
  std::map<std::tuple<std::string, std::string, int>, Entry> entries_;
};

/** Selects, at each of kMaxRate steps a second, the requests whose next image is due. */
class ImageSchedule {
 public:
  /** One step. @return The requests whose image is due; that of a new request is due at once. */
  std::vector<ImageRequest> due(const std::vector<ImageRequest>& requests);

 private:
  /** Fraction of the interval between two images that has passed, by camera and width. */
  std::map<std::pair<std::string, int>, double> credit_;
};

}  // namespace nao::camera
