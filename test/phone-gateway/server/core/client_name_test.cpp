#include "phone-gateway/server/core/client_name.h"

#include <gtest/gtest.h>

namespace nao::gateway {
namespace {

TEST(ClientName, LosesControlCharactersAndOuterSpaces) {
  EXPECT_EQ(clean_client_name("  An\na\x1b[31m "), "Ana[31m");
  EXPECT_EQ(clean_client_name(" \t "), "");
}

TEST(ClientName, IsCutBetweenCharacters) {
  std::string requested;
  for (int i = 0; i < 50; ++i) requested += "\u00e4";
  const std::string name = clean_client_name(requested);
  EXPECT_EQ(name.size(), 80u);
  EXPECT_EQ(name, requested.substr(0, 80));
}

}  // namespace
}  // namespace nao::gateway
