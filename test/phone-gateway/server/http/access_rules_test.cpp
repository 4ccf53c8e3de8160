#include "phone-gateway/server/http/access_rules.h"

#include <gtest/gtest.h>

namespace nao::gateway {
namespace {

const AccessRules kRules({"robot", "robot.local"}, {"http://localhost:5173"});

TEST(AccessRules, AcceptAddressesLocalhostAndOwnNames) {
  for (const char* host : {"192.168.1.5", "192.168.1.5:8080", "localhost", "LocalHost:8080",
                           "[::1]:8080", "[fe80::1]", "robot", "ROBOT.local:80"}) {
    EXPECT_TRUE(kRules.is_known_host(host)) << host;
  }
}

TEST(AccessRules, RefuseOtherNames) {
  for (const char* host :
       {"", "evil.example", "evil.example:8080", "robot.evil.example", "192.168.1.5.evil.example",
        "192.168.1.5:evil", "[::1", "[::1]x", "[robot]", "robot:", "robot:123456", "user@robot"}) {
    EXPECT_FALSE(kRules.is_known_host(host)) << host;
  }
}

TEST(AccessRules, LetOnlyTheServedSiteOpenAWebSocket) {
  EXPECT_TRUE(kRules.is_known_origin("http://192.168.1.5:8080", "192.168.1.5:8080", false));
  EXPECT_TRUE(kRules.is_known_origin("https://192.168.1.5:8080", "192.168.1.5:8080", true));
  EXPECT_TRUE(kRules.is_known_origin("http://localhost:5173", "192.168.1.5:8080", false));
  EXPECT_TRUE(kRules.is_known_origin("", "192.168.1.5:8080", false));
  for (const char* origin : {"http://192.168.1.5", "http://192.168.1.5:8081",
                             "https://192.168.1.5:8080", "http://evil.example", "null",
                             "http://192.168.1.5:8080.evil.example", "http://192.168.1.5:8080/"}) {
    EXPECT_FALSE(kRules.is_known_origin(origin, "192.168.1.5:8080", false)) << origin;
  }
}

}  // namespace
}  // namespace nao::gateway
