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

TEST(Secret, MakesTokensToBeTypedThatDiffer) {
  const std::string token = make_token();
  EXPECT_EQ(token.size(), 9u);
  EXPECT_EQ(token[4], '-');
  EXPECT_EQ(token.find_first_not_of("abcdefghijkmnpqrstuvwxyz23456789-"), std::string::npos);
  EXPECT_EQ(plain_token(token).size(), 8u);
  EXPECT_NE(token, make_token());
}

TEST(Secret, ComparesTokensAsTheyAreTyped) {
  for (const char* typed : {"k7mq-3xpa", "K7MQ-3XPA", "k7mq3xpa", " K7mq 3xpa "}) {
    EXPECT_EQ(plain_token(typed), "k7mq3xpa") << typed;
  }
  EXPECT_NE(plain_token("k7mq-3xp"), "k7mq3xpa");
  EXPECT_EQ(plain_token("- -"), "") << "admits nobody";
}

}  // namespace
}  // namespace nao::gateway
