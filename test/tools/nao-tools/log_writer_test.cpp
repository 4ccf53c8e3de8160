#include "tools/nao-tools/log_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "common/error.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

class LogWriterTest : public testing::Test {
 protected:
  /** Writes ten events of a bit more than 100 bytes each. */
  void write(const LogSplit& split) {
    LogWriter writer(folder_.path() / "run", split);
    for (int i = 0; i < 10; ++i) writer.write({0, i, "CHANNEL", std::vector<uint8_t>(100)});
    writer.flush();
    EXPECT_EQ(writer.num_events(), 10);
  }

  /** Times of the events of a file. */
  std::vector<int64_t> times(const std::string& name) {
    LogReader reader(folder_.path() / name);
    std::vector<int64_t> found;
    while (const auto event = reader.next()) found.push_back(event->wall_utime);
    EXPECT_EQ(reader.num_bytes_skipped(), 0);
    return found;
  }

  const TemporaryFolder folder_;
};

using Times = std::vector<int64_t>;

TEST_F(LogWriterTest, WritesOneFileThatTheReaderReads) {
  write({});
  EXPECT_EQ(times("run"), (Times{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST_F(LogWriterTest, SplitsWithoutLosingEvents) {
  write({500, 0});
  EXPECT_EQ(times("run.00"), (Times{0, 1, 2, 3}));
  EXPECT_EQ(times("run.01"), (Times{4, 5, 6, 7}));
  EXPECT_EQ(times("run.02"), (Times{8, 9}));
}

TEST_F(LogWriterTest, KeepsTheNewestFiles) {
  write({500, 2});
  EXPECT_EQ(times("run.0"), (Times{8, 9}));
  EXPECT_EQ(times("run.1"), (Times{4, 5, 6, 7}));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "run.2"));
}

TEST_F(LogWriterTest, DoesNotOverwriteARecording) {
  write({});
  EXPECT_THROW(LogWriter(folder_.path() / "run", {}), Error);
}

TEST_F(LogWriterTest, NamesTheFileThatCannotBeWritten) {
  EXPECT_THROW(LogWriter("/no/such/folder/run", {}), Error);
}

// A limit of the size of files shows as a full disk does, if its signal is ignored.
TEST_F(LogWriterTest, GoesOnWhenAFullDiskHasSpaceAgain) {
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  LogWriter writer(folder_.path() / "run", {});
  writer.write({0, 0, "CHANNEL", std::vector<uint8_t>(100)});
  writer.flush();
  const rlimit small{200, limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  for (int i = 1; i < 10; ++i) writer.write({0, i, "CHANNEL", std::vector<uint8_t>(100)});
  EXPECT_THROW(writer.flush(), Error);
  EXPECT_EQ(times("run"), Times{0});
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  writer.flush();
  EXPECT_EQ(times("run"), (Times{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(writer.num_lost(), 0);
}

}  // namespace
}  // namespace nao
