#include "phone-gateway/secure_channel/invitations.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>
#include <vector>

#include "common/error.h"
#include "phone-gateway/secure_channel/hexadecimal.h"
#include "phone-gateway/secure_channel/relay_target.h"
#include "phone-gateway/secure_channel/secure_channel.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

constexpr const char* kKey = "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef";

TEST(Invitations, AreValidUntilTheirTime) {
  RelayAccess access;
  access.invitations.push_back(make_invitation(Invitation::Role::kDrive, 100));
  const std::string id = access.invitations[0].id;
  EXPECT_EQ(id.size(), kInvitationIdBytes);
  EXPECT_NE(access.find(id, 99.9), nullptr);
  EXPECT_EQ(access.find(id, 100), nullptr);
  EXPECT_EQ(access.find("other id", 0), nullptr);
}

TEST(Invitations, AreReadAsTheyWereWritten) {
  RelayAccess access;
  access.relay = "relay.example:443";
  access.key = kKey;
  access.invitations = {make_invitation(Invitation::Role::kDrive, 1.5e9),
                        make_invitation(Invitation::Role::kWatch, 1.6e9),
                        make_invitation(Invitation::Role::kOperate, 1.6e9)};
  const std::string text = write_relay_access(access);
  const RelayAccess read = parse_relay_access(text, "file");
  EXPECT_EQ(write_relay_access(read), text);
  EXPECT_EQ(read.invitations[1].role, Invitation::Role::kWatch);
  EXPECT_EQ(read.invitations[2].role, Invitation::Role::kOperate);
  for (const char* bad : {"", "{}", "[1]", "{\"relay\":\"\",\"key\":\"12\",\"invitations\":[]}"}) {
    EXPECT_THROW(parse_relay_access(bad, "file"), ConfigError) << bad;
  }
}

TEST(Invitations, TheFileIsForItsOwnerOnly) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "state" / "relay.json";
  const std::string key = load_relay_access(file).key;
  EXPECT_EQ(load_relay_access(file).key, key);
  struct stat status = {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST(Invitations, ChangesAtOneTimeAreAllKept) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "relay.json";
  const auto invite = [&file] {
    for (int i = 0; i < 5; ++i) {
      change_relay_access(file, [](RelayAccess& access) {
        access.invitations.push_back(make_invitation(Invitation::Role::kDrive, 1e10));
      });
    }
  };
  std::vector<std::thread> programs;
  for (int i = 0; i < 8; ++i) programs.emplace_back(invite);
  for (std::thread& program : programs) program.join();
  EXPECT_EQ(load_relay_access(file).invitations.size(), 40u);
}

TEST(Invitations, AChangeThatFailsLeavesTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "relay.json";
  const std::string key = load_relay_access(file).key;
  EXPECT_THROW(change_relay_access(file,
                                   [](RelayAccess& access) {
                                     access.key = kKey;
                                     throw Error("refused");
                                   }),
               Error);
  EXPECT_EQ(load_relay_access(file).key, key);
}

TEST(Invitations, TheLinkKeepsTheSecretFromTheRelay) {
  RelayAccess access;
  access.relay = "relay.example";
  access.key = kKey;
  const Invitation invitation{std::string(8, '\x01'), std::string(16, '\x02'), {}, 0};
  const std::string link = invitation_link(access, invitation);
  EXPECT_EQ(link, "https://relay.example:8443/#token=" + robot_of_key(kKey) +
                      ".0101010101010101.02020202020202020202020202020202");
  access.relay = "[2001:db8::1]:443";
  EXPECT_TRUE(invitation_link(access, invitation).starts_with("https://[2001:db8::1]/#token="));
}

TEST(RelayAddress, IsHostAndPort) {
  EXPECT_EQ(parse_relay_address("relay.example:9").port, "9");
  EXPECT_EQ(parse_relay_address("[::1]").host, "::1");
  for (const char* bad :
       {"", ":1", "a:", "a:0", "a:65536", "a:1b", "[::1", "[::1]x", "a b", "a/b"}) {
    EXPECT_THROW(parse_relay_address(bad), ConfigError) << bad;
  }
}

TEST(RelayTarget, IsARobotAKeyOrATicket) {
  const auto target = parse_relay_target(std::string("/ws?key=") + kKey);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->kind, RelayTarget::Kind::kRobot);
  EXPECT_EQ(write_relay_target(*target), std::string("/ws?key=") + kKey);
  EXPECT_EQ(robot_of_key(kKey).size(), 2 * kRobotIdBytes);
  EXPECT_NE(robot_of_key(kKey), robot_of_key("1" + std::string(kKey).substr(1)));
  for (const char* bad :
       {"/ws", "/ws?robot=", "/ws?robot=12", "/ws?ticket=0123456789ABCDEF0123456789ABCDEF"}) {
    EXPECT_FALSE(parse_relay_target(bad)) << bad;
  }
  EXPECT_EQ(from_hex(to_hex("\x80\x7f"), 2), "\x80\x7f");
}

}  // namespace
}  // namespace nao
