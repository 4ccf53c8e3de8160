#include "phone-gateway/server/client_name.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

TEST(ClientName, LosesControlCharactersAndOuterSpaces) {
  EXPECT_EQ(clean_client_name("  An\na\x1b[31m "), "Ana[31m");
  EXPECT_EQ(clean_client_name(" \t "), "");
}

TEST(ClientName, IsCutBetweenCharacters) {
  std::string wished;
  for (int i = 0; i < 50; ++i) wished += "\u00e4";
  const std::string name = clean_client_name(wished);
  EXPECT_EQ(name.size(), 80u);
  EXPECT_EQ(name, wished.substr(0, 80));
}

}  // namespace
}  // namespace nao
