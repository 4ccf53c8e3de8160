#include "common/log_reader.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "common/error.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

using Bytes = std::vector<uint8_t>;

class LogReaderTest : public testing::Test {
 protected:
  /** All events read from these bytes. */
  std::vector<LogEvent> read(const Bytes& bytes) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    LogReader reader(path_);
    std::vector<LogEvent> events;
    while (auto event = reader.next()) events.push_back(*event);
    num_bytes_skipped_ = reader.num_bytes_skipped();
    num_events_skipped_ = reader.num_events_skipped();
    num_clock_steps_ = reader.clock().num_steps();
    return events;
  }

  static LogEvent event(int64_t number) {
    return {number, 1'700'000'000'000'000 + number, "CHANNEL", {1, 2, 3, 4, 5}};
  }

  static Bytes log_of(int num_events) {
    Bytes bytes;
    for (int i = 0; i < num_events; ++i) {
      const Bytes more = encode_log_event(event(i));
      bytes.insert(bytes.end(), more.begin(), more.end());
    }
    return bytes;
  }

  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "test.log";
  int64_t num_bytes_skipped_ = 0;
  int64_t num_events_skipped_ = 0;
  int64_t num_clock_steps_ = 0;
};

TEST_F(LogReaderTest, ReadsTheDocumentedFormat) {
  const Bytes bytes{0xED, 0xA1, 0xDA, 0x01, 0, 0, 0, 0, 0, 0, 0, 7, 0,   0,   0, 0,
                    0,    0,    1,    0,    0, 0, 0, 2, 0, 0, 0, 1, 'A', 'B', 9};
  const auto events = read(bytes);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].number, 7);
  EXPECT_EQ(events[0].wall_utime, 256);
  EXPECT_EQ(events[0].channel, "AB");
  EXPECT_EQ(events[0].data, Bytes{9});
  EXPECT_EQ(encode_log_event(events[0]), bytes);
}

TEST_F(LogReaderTest, ContinuesAfterDamagedBytes) {
  Bytes bytes = log_of(5);
  const size_t event_size = bytes.size() / 5;
  bytes[2 * event_size] ^= 0xFF;
  const auto events = read(bytes);
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events[2].number, 3);
  EXPECT_EQ(num_bytes_skipped_, static_cast<int64_t>(event_size));
}

TEST_F(LogReaderTest, SkipsATruncatedEvent) {
  Bytes bytes = log_of(3);
  const size_t event_size = bytes.size() / 3;
  bytes.resize(bytes.size() - 1);
  EXPECT_EQ(read(bytes).size(), 2u);
  EXPECT_EQ(num_bytes_skipped_, static_cast<int64_t>(event_size - 1));
}

TEST_F(LogReaderTest, SurvivesGarbage) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    Bytes bytes = log_of(8);
    for (int i = 0; i < 12; ++i) bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
    bytes.resize(random() % (bytes.size() + 1));
    const auto events = read(bytes);
    EXPECT_LE(events.size(), 8u);
  }
}

TEST_F(LogReaderTest, FindsTheNextEventWhereverABlockOfZerosEnds) {
  for (size_t num_zeros = 65'500; num_zeros < 65'600; ++num_zeros) {
    Bytes bytes(num_zeros, 0);
    const Bytes tail = log_of(2);
    bytes.insert(bytes.end(), tail.begin(), tail.end());
    ASSERT_EQ(read(bytes).size(), 2u) << num_zeros;
    ASSERT_EQ(num_bytes_skipped_, static_cast<int64_t>(num_zeros));
  }
}

TEST_F(LogReaderTest, SkipsOnlyTheEventThatHasAWildLength) {
  for (const uint8_t high_byte : {0x00, 0x7F}) {
    Bytes bytes = log_of(1000);
    const size_t event_size = bytes.size() / 1000;
    bytes[2 * event_size + 24] = high_byte;
    bytes[2 * event_size + 26] = 0x80;
    const auto events = read(bytes);
    ASSERT_EQ(events.size(), 999u);
    EXPECT_EQ(events[2].number, 3);
    EXPECT_EQ(num_bytes_skipped_, static_cast<int64_t>(event_size));
    EXPECT_EQ(num_events_skipped_, 1);
  }
}

TEST_F(LogReaderTest, CountsTheEventsOfADamagedPart) {
  Bytes bytes = log_of(100);
  const size_t event_size = bytes.size() / 100;
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(10 * event_size), 20 * event_size, 0x5A);
  EXPECT_EQ(read(bytes).size(), 80u);
  EXPECT_EQ(num_events_skipped_, 20);
}

TEST_F(LogReaderTest, BridgesOneMessageOf1970ByTheRobotsTime) {
  Bytes bytes;
  for (int i = 0; i < 10; ++i) {
    LogEvent one = event(i);
    one.channel = "NAO_SENSOR_STATE";
    one.wall_utime = i == 5 ? 12 : 1'700'000'000'000'000 + i * 10'000;
    one.data = Bytes(16, 0);
    const int64_t robot_utime = 1'000'000 + i * 10'000;
    for (int k = 0; k < 8; ++k) one.data[15 - k] = static_cast<uint8_t>(robot_utime >> 8 * k);
    const Bytes more = encode_log_event(one);
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  const auto events = read(bytes);
  ASSERT_EQ(events.size(), 10u);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(events[i].wall_utime, 1'700'000'000'000'000 + i * 10'000) << i;
  }
  EXPECT_EQ(num_clock_steps_, 2);
}

TEST_F(LogReaderTest, TakesAChannelNameWithControlBytesForDamage) {
  LogEvent odd = event(0);
  odd.channel = "A\x1b[2J";
  Bytes bytes = encode_log_event(odd);
  const Bytes tail = log_of(2);
  const size_t num_damaged = bytes.size();
  bytes.insert(bytes.end(), tail.begin(), tail.end());
  EXPECT_EQ(read(bytes).size(), 2u);
  EXPECT_EQ(num_bytes_skipped_, static_cast<int64_t>(num_damaged));
}

TEST_F(LogReaderTest, NamesTheMissingFile) {
  try {
    const LogReader reader("/no/such.lcmlog");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such.lcmlog"), std::string::npos);
  }
}

}  // namespace
}  // namespace nao
