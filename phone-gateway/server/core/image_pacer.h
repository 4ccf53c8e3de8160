#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "phone-gateway/server/core/request_check.h"

namespace nao::gateway {

/** Keeps the images of one client from filling its link: the next one is sent when the last one has
 * arrived, and a link on which that takes long gets smaller ones.
 *
 * States wait behind an image, and an image behind the one before it. So the time that an image
 * takes bounds the age of both. */
class ImagePacer {
 public:
  /** @param unacknowledged  Bytes that the other end has not acknowledged. @param round_trip_time
   *   As the transport measures it, s; 0: not known. @param now  s. */
  void update(size_t unacknowledged, double round_trip_time, double now) {
    if (round_trip_time > 0) least_round_trip_ = std::min(least_round_trip_, round_trip_time);
    const size_t rest = std::min(kFreeBytes, size_ / 2);
    is_free_ = unacknowledged <= rest + written_since_;
    if (!is_under_way_ || !is_free_) return;
    is_under_way_ = false;
    const double time = now - sent_at_ - (least_round_trip_ < kUnknown ? least_round_trip_ : 0);
    // The rest of the image takes as long for each byte.
    adapt(time * static_cast<double>(size_) / static_cast<double>(size_ - rest));
  }

  /** @param size  Bytes of the image. */
  void note_sent(size_t size, double now) {
    size_ = std::max<size_t>(size, 1);
    written_since_ = 0;
    sent_at_ = now;
    is_under_way_ = true;
    is_free_ = false;
  }

  /** Something else was sent over the same connection: over a long link much of it is under way
   * when the image has arrived. @param size  Bytes. */
  void note_other(size_t size) { written_since_ += size; }

  /** Whether the last image has arrived. */
  bool may_send() const { return is_free_; }
  /** Whether update() must be called soon, to measure the time of the last image. */
  bool is_under_way() const { return is_under_way_; }
  /** Whether it must be called now: otherwise there is time until something else is sent. */
  bool is_to_be_measured(double now) const {
    return is_under_way_ && now - sent_at_ >= kMeasuringPeriod;
  }

  /** The images that this link can take, of those that the client wants. */
  ImageSelection reduce(ImageSelection wanted) const {
    int level = level_;
    for (; level >= kNumQualities && wanted.width / 2 >= kLeastWidth; level -= kNumQualities) {
      wanted.width /= 2;
    }
    const uint32_t quality = kQualities[std::min(level, kNumQualities - 1)];
    if (quality < effective_quality(wanted.quality)) wanted.quality = quality;
    return wanted;
  }

 private:
  /** Acknowledgements are sent for every second segment of about 1,460 bytes: less than this is an
   * idle link. */
  static constexpr size_t kFreeBytes = 4096;
  /** Times that an image may take, s. Above the first the next one is smaller; if twenty in
   * succession take less than the second, one is larger. Chosen: a level has at most twice the
   * bytes of the next, an image of 0.1 s leaves a state age of 0.12 s, and the arrival of a small
   * one is noticed within two of the gateway's steps of 0.02 s. */
  static constexpr double kLongTime = 0.1;
  static constexpr double kShortTime = 0.05;
  static constexpr int kNumShort = 20;
  /** s. Chosen: a step of the gateway. */
  static constexpr double kMeasuringPeriod = 0.02;
  /** JPEG qualities of the levels of one width. */
  static constexpr int kNumQualities = 3;
  static constexpr std::array<uint32_t, kNumQualities> kQualities = {95, 50, 30};
  static constexpr uint32_t kLeastWidth = 160;
  static constexpr int kMaxLevel = 3 * kNumQualities - 1;

  void adapt(double time) {
    num_short_ = time < kShortTime ? num_short_ + 1 : 0;
    if (time > kLongTime) {
      level_ = std::min(level_ + 1, kMaxLevel);
    } else if (num_short_ >= kNumShort) {
      level_ = std::max(level_ - 1, 0);
      num_short_ = 0;
    }
  }

  static constexpr double kUnknown = 1e9;

  /** The least that was measured: of the link without a queue, s. */
  double least_round_trip_ = kUnknown;
  bool is_free_ = true;
  bool is_under_way_ = false;
  double sent_at_ = 0;
  size_t size_ = 2 * kFreeBytes;
  /** Bytes sent after the last image. */
  size_t written_since_ = 0;
  /** 0: as the client wants them; each of the next two lowers the quality, the one after them
   * halves the width. */
  int level_ = 0;
  int num_short_ = 0;
};

}  // namespace nao::gateway
