#include "viewer/log_file.h"

#include <gtest/gtest.h>

#include <utility>

#include "common/error.h"
#include "test/support/temporary_folder.h"
#include "viewer/log_player.h"

namespace nao::viewer {
namespace {

/** Bytes of a log in the format of LCM's documentation, written without lcm. */
class LogBytes {
 public:
  void add(int64_t utime, const std::string& channel, const std::string& data) {
    number(0xEDA1DA01, 4);
    number(num_events_++, 8);
    number(static_cast<uint64_t>(utime), 8);
    number(channel.size(), 4);
    number(data.size(), 4);
    bytes_ += channel + data;
  }
  std::string& bytes() { return bytes_; }

 private:
  void number(uint64_t value, int num_bytes) {
    for (int i = num_bytes - 1; i >= 0; --i) bytes_ += static_cast<char>(value >> (8 * i));
  }
  std::string bytes_;
  uint64_t num_events_ = 0;
};

class LogFileTest : public testing::Test {
 protected:
  LogFile open(const std::string& bytes) {
    write_text(path_, bytes);
    return LogFile(path_);
  }

  /** A and B every second for five seconds, C once. */
  static LogBytes some_log() {
    LogBytes log;
    for (int i = 0; i < 5; ++i) {
      const int64_t utime = 1700000000000000 + 1000000 * i;
      log.add(utime, "A", "a" + std::to_string(i));
      log.add(utime + 500000, "B", "b" + std::to_string(i));
      if (i == 1) log.add(utime + 600000, "C", "c");
    }
    return log;
  }

  /** Appends what is visited to seen_: "A=a0 B=b0 ". */
  LogFile::Visitor record() {
    return [this](const std::string& channel, const std::vector<uint8_t>& data, double time) {
      seen_ += channel + "=" + std::string(data.begin(), data.end()) + " ";
      times_.push_back(time);
    };
  }

  /** Returns and clears seen_. */
  std::string seen() { return std::exchange(seen_, ""); }

  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "test.log";
  std::string seen_;
  std::vector<double> times_;
};

TEST_F(LogFileTest, ReadsTheMessagesOfATimeInterval) {
  LogFile log = open(some_log().bytes());
  EXPECT_EQ(log.num_events(), 11u);
  EXPECT_NEAR(log.duration(), 4.5, 1e-9);
  log.read(1.0, 2.0, record());
  EXPECT_EQ(seen(), "B=b1 C=c A=a2 ");
  EXPECT_NEAR(times_[0], 1.5, 1e-9);
}

TEST_F(LogFileTest, FindsTheNewestMessageOfEveryChannel) {
  LogFile log = open(some_log().bytes());
  log.read_latest(3.7, record());
  EXPECT_EQ(seen(), "C=c A=a3 B=b3 ");
  log.read_latest(-1, record());
  EXPECT_EQ(seen(), "");
}

TEST_F(LogFileTest, SkipsATruncatedEnd) {
  LogBytes log = some_log();
  log.bytes().resize(log.bytes().size() - 1);
  EXPECT_EQ(open(log.bytes()).num_events(), 10u);
  EXPECT_EQ(open(some_log().bytes() + "garbage that is not an event header").num_events(), 11u);
}

TEST_F(LogFileTest, RejectsAFileThatIsNotALog) {
  EXPECT_THROW(open(""), Error);
  EXPECT_THROW(open("This is a text file that is long enough."), Error);
  EXPECT_THROW(LogFile("/nonexistent.log"), Error);
}

TEST_F(LogFileTest, PlaysSeeksAndPausesAtTheEnd) {
  LogPlayer player(open(some_log().bytes()));
  player.advance(0.1, record());
  EXPECT_EQ(seen(), "A=a0 ");
  player.speed = 2;
  player.advance(0.72, record());
  EXPECT_EQ(seen(), "B=b0 A=a1 B=b1 ");
  player.is_paused = true;
  player.advance(5, record());
  EXPECT_EQ(seen(), "");
  player.seek(0.2, 1, record());  // back
  EXPECT_EQ(seen(), "A=a0 ");
  player.is_paused = false;
  player.advance(100, record());
  EXPECT_EQ(seen().size(), 49u);
  EXPECT_TRUE(player.is_paused);
}

}  // namespace
}  // namespace nao::viewer
