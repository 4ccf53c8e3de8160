#include "phone-gateway/web_stream/access_rules.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace nao {
namespace {

std::vector<std::string> own_names() {
  return {"Uni-X.de.", ""};
}
const AccessRules kRules({"Robot", "robot.example"}, {"http://localhost:5173"}, own_names);

TEST(AccessRules, AcceptAddressesLocalhostAndOwnNames) {
  for (const char* host : {"192.168.1.5", "192.168.1.5:8080", "localhost", "LocalHost:8080",
                           "[::1]:8080", "[fe80::1]", "robot", "ROBOT.local:80", "robot.example"}) {
    EXPECT_TRUE(kRules.is_known_host(host)) << host;
  }
}

TEST(AccessRules, AcceptTheNamesThatRoutersAndTheNetworkGiveThisHost) {
  for (const char* host : {"robot.fritz.box", "Robot.lan:8080", "robot.home.arpa", "robot.uni-x.de",
                           "robot.UNI-X.de.:8080"}) {
    EXPECT_TRUE(kRules.is_known_host(host)) << host;
  }
  EXPECT_FALSE(AccessRules({"robot"}, {}).is_known_host("robot.uni-x.de"));
}

TEST(AccessRules, NameEveryHostForACertificateOnce) {
  std::vector<std::string> names = kRules.all_host_names();
  for (const char* name : {"robot", "robot.local", "robot.fritz.box", "robot.uni-x.de",
                           "robot.example", "localhost"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
  for (const std::string& name : names) EXPECT_TRUE(kRules.is_known_host(name)) << name;
  EXPECT_EQ(std::count(names.begin(), names.end(), "robot.example.local"), 0);
}

TEST(AccessRules, AcceptADotAtTheEndSubdomainsOfLocalhostAndZones) {
  for (const char* host : {"robot.", "robot.local.:8080", "localhost.", "a.localhost",
                           "a.b.localhost:8080", "[fe80::1%25eth0]:8080", "[fe80::1%eth0]"}) {
    EXPECT_TRUE(kRules.is_known_host(host)) << host;
  }
}

TEST(AccessRules, FindPagesOfThisComputerByTheirOrigin) {
  for (const char* origin : {"http://localhost", "https://localhost:8000", "http://127.0.0.1:8080",
                             "http://[::1]:3000", "http://app.localhost"}) {
    EXPECT_TRUE(is_origin_on_this_computer(origin)) << origin;
  }
  for (const char* origin :
       {"", "null", "file://", "localhost", "http://evil.example", "http://127.0.0.1.evil.example",
        "http://localhost.evil.example", "http://192.168.1.5", "ftp://localhost"}) {
    EXPECT_FALSE(is_origin_on_this_computer(origin)) << origin;
  }
}

TEST(AccessRules, RefuseOtherNames) {
  for (const char* host : {"",
                           "evil.example",
                           "evil.example:8080",
                           "robot.evil.example",
                           "192.168.1.5.evil.example",
                           "192.168.1.5:evil",
                           "robot..",
                           ".",
                           ".localhost.evil.example",
                           "robotlan",
                           "evil.lan",
                           "a.robot.lan",
                           "robot.uni-x.de.evil.example",
                           "fritz.box",
                           "uni-x.de",
                           "robot.evil.lan",
                           "127.0.0.1%eth0",
                           "[::1",
                           "[::1]x",
                           "[robot]",
                           "robot:",
                           "robot:123456",
                           "user@robot"}) {
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
}  // namespace nao
