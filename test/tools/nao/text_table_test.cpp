#include "tools/nao/text_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao {
namespace {

TEST(TextTable, AlignsNumbersRightAndTextLeft) {
  EXPECT_EQ(format_table({{"joint", "rad"}, {"HeadYaw", "0.10"}, {"LHand", "-1.00"}}),
            "joint      rad\n"
            "HeadYaw   0.10\n"
            "LHand    -1.00\n");
}

TEST(TextTable, CountsCharactersNotBytes) {
  EXPECT_EQ(format_table({{"µs", "x"}, {"a", "b"}}), "µs  x\na   b\n");
}

TEST(TextTable, ShowsADashForNan) {
  EXPECT_EQ(format_number(std::nan(""), 2), "-");
  EXPECT_EQ(format_number(1.005, 1), "1.0");
}

}  // namespace
}  // namespace nao
