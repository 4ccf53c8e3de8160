#include "phone-gateway/server/core/secret.h"

#include <gtest/gtest.h>

namespace nao::gateway {
namespace {

TEST(Secret, EqualsItselfOnly) {
  EXPECT_TRUE(equals_secret("k7", "k7"));
  for (const char* received : {"", "k", "k8", "j7", "k7k7", "k77"}) {
    EXPECT_FALSE(equals_secret(received, "k7")) << received;
  }
  EXPECT_FALSE(equals_secret("x", ""));
}

TEST(Secret, MakesLongTokensThatDiffer) {
  const std::string token = make_token();
  EXPECT_EQ(token.size(), 16u);
  EXPECT_EQ(token.find_first_not_of("abcdefghijkmnpqrstuvwxyz23456789"), std::string::npos);
  EXPECT_NE(token, make_token());
}

}  // namespace
}  // namespace nao::gateway
