#include "phone-gateway/server/core/image_pacer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace nao::gateway {
namespace {

/** Sends images over a link of some bytes a second for a time. */
class PacedLink {
 public:
  explicit PacedLink(double rate, double round_trip = 0.005)
      : rate_(rate), round_trip_(round_trip) {}

  /** @return The longest time from the choice of an image to its arrival in the last half, s. */
  double run(double seconds) {
    double longest = 0;
    const double end = now_ + seconds;
    const double middle = now_ + seconds / 2;
    for (; now_ < end; now_ += 0.001) {
      const double queued = std::max(0.0, busy_until_ - now_) * rate_;
      pacer_.update(static_cast<size_t>(queued), round_trip_, now_);
      if (!pacer_.may_send()) continue;
      // A byte for eight pixels at the usual quality.
      const ImageSelection image = pacer_.reduce({"top", 640, 0});
      const double factor = image.quality == 50 ? 0.55 : image.quality == 30 ? 0.4 : 1;
      const double size = image.width * image.width * 0.75 / 8 * factor;
      pacer_.note_sent(static_cast<size_t>(size), now_);
      busy_until_ = now_ + size / rate_ + round_trip_;
      ++num_images_;
      if (now_ > middle) longest = std::max(longest, busy_until_ - now_);
    }
    return longest;
  }
  void set_rate(double rate) { rate_ = rate; }
  ImageSelection image() const { return pacer_.reduce({"top", 640, 0}); }
  int num_images() const { return num_images_; }

 private:
  ImagePacer pacer_;
  double rate_;
  double round_trip_;
  double now_ = 0;
  double busy_until_ = 0;
  int num_images_ = 0;
};

TEST(ImagePacer, ChangesNothingOnAGoodLink) {
  PacedLink link(5e6);
  link.run(10);
  EXPECT_EQ(link.image().width, 640u);
  EXPECT_EQ(link.image().quality, 0u);
}

TEST(ImagePacer, KeepsImagesShortOnALinkOfOneMegabit) {
  PacedLink link(125e3);
  EXPECT_LT(link.run(20), 0.15);
  EXPECT_GT(link.num_images(), 100);
  EXPECT_LT(link.image().width, 640u);
}

TEST(ImagePacer, ALongRoundTripAloneMakesNoImageSmaller) {
  PacedLink link(5e6, 0.3);
  link.run(20);
  EXPECT_EQ(link.image().width, 640u);
}

TEST(ImagePacer, StatesThatAreUnderWayHoldUpNoImage) {
  ImagePacer pacer;
  pacer.note_sent(10000, 0);
  // Over a link of 0.2 s more states are under way at any time than a free link has bytes.
  for (int i = 0; i < 12; ++i) pacer.note_other(400);
  pacer.update(10000 + 12 * 400, 0.2, 0.19);
  EXPECT_FALSE(pacer.may_send());
  pacer.update(12 * 400, 0.2, 0.2);
  EXPECT_TRUE(pacer.may_send());
}

TEST(ImagePacer, GoesBackToLargeImagesWhenTheLinkIsGoodAgain) {
  PacedLink link(15e3);
  link.run(20);
  EXPECT_EQ(link.image().width, 160u);
  link.set_rate(5e6);
  link.run(30);
  EXPECT_EQ(link.image().width, 640u);
  EXPECT_EQ(link.image().quality, 0u);
}

}  // namespace
}  // namespace nao::gateway
