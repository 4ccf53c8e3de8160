#pragma once

#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace nao {

/** A stream of pictures that somebody wants. */
struct PictureWish {
  /** "top" or "bottom". */
  std::string camera;
  /** Pixels: 640, 320 or 160. */
  int width = 0;
  /** Pictures a second, 1 to 30. */
  double rate = 0;
  /** JPEG quality, 1 to 95; 0 leaves it to the camera. */
  int quality = 0;
};

/** Sizes that are made, and the fastest rate, pictures a second. */
inline constexpr int kFullWidth = 640;
inline constexpr int kFullHeight = 480;
inline constexpr double kFastestRate = 30;

/** Why a wish cannot be met, a sentence; empty if it can. */
std::string refuse_wish(const PictureWish& wish);

/** Remembers who watches which picture. Wishes end 2 s after they were last repeated. */
class PictureWishes {
 public:
  /** @param now  s, never running backwards. */
  void add(const std::string& source, const PictureWish& wish, double now);

  /** What is wanted now: one wish for each camera and width, with the highest rate and quality that
   * anybody asked for. */
  std::vector<PictureWish> merged(double now);

 private:
  struct Entry {
    PictureWish wish;
    double until;
  };
  /** By source, camera and width. */
  std::map<std::tuple<std::string, std::string, int>, Entry> entries_;
};

/** Thins turns of kFastestRate out to the rates wished for. */
class PictureSchedule {
 public:
  /** One turn. @return Those of the wishes whose picture is due now. */
  std::vector<PictureWish> due(const std::vector<PictureWish>& wishes);

 private:
  /** Share of a picture that has come due, by camera and width. */
  std::map<std::pair<std::string, int>, double> credit_;
};

}  // namespace nao
