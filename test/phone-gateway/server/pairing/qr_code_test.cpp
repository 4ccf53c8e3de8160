#include "phone-gateway/server/pairing/qr_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/error.h"

namespace nao::gateway {
namespace {

/** A finder pattern: 7x7 dark, within it a light ring, within that 3x3 dark. */
bool is_finder(const QrCode& code, int row, int column) {
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 7; ++x) {
      const bool is_ring =
          (x == 1 || x == 5 || y == 1 || y == 5) && x > 0 && x < 6 && y > 0 && y < 6;
      if (code.at(row + y, column + x) == is_ring) return false;
    }
  }
  return true;
}

TEST(QrCode, HasFinderPatternsInThreeCorners) {
  const QrCode code = make_qr_code("http://192.168.1.20:8080/#token=abcdefghijkmnpqr");
  EXPECT_EQ(code.width % 4, 1) << "17 + 4 per version";
  EXPECT_TRUE(is_finder(code, 0, 0));
  EXPECT_TRUE(is_finder(code, 0, code.width - 7));
  EXPECT_TRUE(is_finder(code, code.width - 7, 0));
  EXPECT_FALSE(is_finder(code, code.width - 7, code.width - 7));
}

TEST(QrCode, RefusesTextsThatAreTooLong) {
  EXPECT_THROW((void)make_qr_code(std::string(5000, 'x')), Error);
}

TEST(QrCode, DrawsALineForTwoRows) {
  const QrCode code = make_qr_code("x");
  const std::string drawn = draw_on_terminal(code);
  EXPECT_EQ(std::count(drawn.begin(), drawn.end(), '\n'), (code.width + 4 + 1) / 2);
}

TEST(QrCode, DrawsAPngOfItsSize) {
  const QrCode code = make_qr_code("x");
  const std::string png = draw_as_png(code, 8);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto width =
      static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]);
  EXPECT_EQ(width, (code.width + 8) * 8);
}

}  // namespace
}  // namespace nao::gateway
