#include "lola/socket.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <filesystem>

#include "common/error.h"
#include "test/libs/lola/lola_frames.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

class LolaSocket : public testing::Test {
 protected:
  std::string path() const { return (folder_.path() / "lola").string(); }

  /** A connected pair: the robot's end and the client's. */
  std::pair<LolaConnection<LolaCommand>, LolaConnection<LolaState>> connected() {
    auto client = UnixSocket::connect(path());
    auto robot = listener_.accept();
    return {LolaConnection<LolaCommand>(std::move(*robot)),
            LolaConnection<LolaState>(std::move(*client))};
  }

  TemporaryFolder folder_;
  UnixSocket listener_ = UnixSocket::listen(path());
};

TEST_F(LolaSocket, CarriesFramesBothWays) {
  auto [robot, client] = connected();
  robot.send(encoded(numbered_state()));
  client.receive();
  LolaState state;
  ASSERT_TRUE(client.next(state));
  EXPECT_EQ(encoded(state), encoded(numbered_state()));
  EXPECT_FALSE(client.next(state));
  client.send(encoded(numbered_command()));
  client.send(encoded(numbered_command()));
  robot.receive();
  LolaCommand command;
  EXPECT_TRUE(robot.next(command));
  EXPECT_TRUE(robot.next(command));
  EXPECT_FALSE(robot.next(command));
  EXPECT_EQ(robot.end(), "");
}

TEST_F(LolaSocket, APeerThatClosesAtAnyByteEndsTheConnection) {
  const std::vector<uint8_t> bytes = encoded(numbered_state());
  for (size_t size = 0; size <= bytes.size(); ++size) {
    auto client_socket = UnixSocket::connect(path());
    LolaConnection<LolaState> client(std::move(*client_socket));
    {
      const auto robot = listener_.accept();
      ASSERT_EQ(send(robot->descriptor(), bytes.data(), size, 0), static_cast<ssize_t>(size));
    }
    LolaState state;
    int num_states = 0;
    while (client.end().empty()) {
      client.receive();
      while (client.next(state)) ++num_states;
    }
    EXPECT_EQ(num_states, size == bytes.size() ? 1 : 0);
    EXPECT_EQ(client.end(), "the other end has closed the connection");
    client.send(encoded(numbered_command()));
  }
}

TEST_F(LolaSocket, APeerThatDoesNotReadEndsTheConnection) {
  auto [robot, client] = connected();
  const std::vector<uint8_t> frame = encoded(numbered_state());
  // Linux keeps some hundred kilobytes for a socket.
  for (int i = 0; i < 5000 && robot.end().empty(); ++i) robot.send(frame);
  EXPECT_EQ(robot.end(), "the other end does not read");
}

TEST_F(LolaSocket, AnUnreadableMessageEndsTheConnection) {
  auto [robot, client] = connected();
  client.send(std::vector<uint8_t>{0x93, 1, 2, 3});
  robot.receive();
  LolaCommand command;
  EXPECT_FALSE(robot.next(command));
  EXPECT_EQ(robot.end(), "unreadable message: it is not a map");
}

TEST_F(LolaSocket, ListensOnceAtAPath) {
  EXPECT_THROW(UnixSocket::listen(path()), Error);
}

TEST_F(LolaSocket, ReplacesTheFileOfACrashedProgramAndNoOther) {
  listener_ = UnixSocket();
  EXPECT_TRUE(std::filesystem::exists(path()));
  EXPECT_FALSE(UnixSocket::connect(path()));
  listener_ = UnixSocket::listen(path());
  EXPECT_TRUE(UnixSocket::connect(path()));
  const std::string file = path() + ".txt";
  write_text(file, "precious");
  EXPECT_THROW(UnixSocket::listen(file), Error);
  EXPECT_EQ(std::filesystem::file_size(file), 8u);
}

TEST_F(LolaSocket, RefusesAPathThatIsTooLong) {
  EXPECT_THROW((void)UnixSocket::connect(std::string(200, 'x')), Error);
}

}  // namespace
}  // namespace nao
