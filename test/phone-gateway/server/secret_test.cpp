#include "phone-gateway/server/secret.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

TEST(Secret, EqualsItselfOnly) {
  EXPECT_TRUE(equals_secret("k7", "k7"));
  for (const char* said : {"", "k", "k8", "j7", "k7k7", "k77"}) {
    EXPECT_FALSE(equals_secret(said, "k7")) << said;
  }
  EXPECT_FALSE(equals_secret("x", ""));
}

TEST(Secret, TokensAreLongAndNew) {
  const std::string token = make_token();
  EXPECT_EQ(token.size(), 16u);
  EXPECT_EQ(token.find_first_not_of("abcdefghijkmnpqrstuvwxyz23456789"), std::string::npos);
  EXPECT_NE(token, make_token());
}

}  // namespace
}  // namespace nao
