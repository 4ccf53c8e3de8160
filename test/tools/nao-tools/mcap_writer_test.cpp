#include "tools/nao-tools/mcap_writer.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

// Opcodes: https://mcap.dev/spec, "Opcodes".
constexpr char kFooter = 0x02;
constexpr char kMessage = 0x05;
constexpr char kChunk = 0x06;
constexpr char kMessageIndex = 0x07;
constexpr char kChunkIndex = 0x08;
constexpr char kStatistics = 0x0B;

uint64_t number(const std::string& bytes, size_t offset, int size) {
  uint64_t value = 0;
  for (int i = size - 1; i >= 0; --i) {
    value = value << 8 | static_cast<uint8_t>(bytes.at(offset + static_cast<size_t>(i)));
  }
  return value;
}

struct Record {
  char opcode;
  size_t offset;
  std::string content;
};

/** The records between two offsets, each opcode, size and content. */
std::vector<Record> records(const std::string& bytes, size_t begin, size_t end) {
  std::vector<Record> found;
  while (begin < end) {
    const size_t size = number(bytes, begin + 1, 8);
    found.push_back({bytes.at(begin), begin, bytes.substr(begin + 9, size)});
    begin += 9 + size;
  }
  EXPECT_EQ(begin, end);
  return found;
}

class McapWriterTest : public testing::Test {
 protected:
  std::string written(int num_messages, size_t message_size) {
    McapWriter writer(path_);
    const uint16_t schema = writer.add_schema("naolcm.test_t", "{}");
    const uint16_t even = writer.add_channel("EVEN", schema);
    const uint16_t odd = writer.add_channel("ODD", schema);
    for (int i = 0; i < num_messages; ++i) {
      writer.add_message(i % 2 == 0 ? even : odd, 1000 + i, std::string(message_size, 'x'));
    }
    writer.finish();
    return read_text(path_);
  }

  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "test.mcap";
};

TEST_F(McapWriterTest, TheIndexFindsEveryMessage) {
  const std::string magic{"\x89MCAP0\r\n", 8};
  const std::string bytes = written(60, 100'000);  // several chunks
  ASSERT_TRUE(bytes.starts_with(magic));
  ASSERT_TRUE(bytes.ends_with(magic));
  const auto all = records(bytes, 8, bytes.size() - 8);
  ASSERT_EQ(all.back().opcode, kFooter);
  const size_t summary = number(all.back().content, 0, 8);

  int num_chunks = 0;
  int num_found = 0;
  for (const Record& index : all) {
    if (index.opcode != kChunkIndex) continue;
    EXPECT_GE(index.offset, summary);
    ++num_chunks;
    const size_t chunk = number(index.content, 16, 8);
    ASSERT_EQ(bytes.at(chunk), kChunk);
    EXPECT_EQ(number(bytes, chunk + 1, 8) + 9, number(index.content, 24, 8));
    const std::string chunk_content = bytes.substr(chunk + 9, number(bytes, chunk + 1, 8));
    // First and last time, size, checksum, name of the compression (none), size.
    const std::string contained = chunk_content.substr(8 + 8 + 8 + 4 + 4 + 8);
    ASSERT_EQ(contained.size(), number(chunk_content, 16, 8));
    const size_t num_channels = number(index.content, 32, 4) / 10;
    for (size_t k = 0; k < num_channels; ++k) {
      const size_t place = number(index.content, 36 + 10 * k + 2, 8);
      ASSERT_EQ(bytes.at(place), kMessageIndex);
      const size_t num_messages = number(bytes, place + 9 + 2, 4) / 16;
      for (size_t m = 0; m < num_messages; ++m) {
        const size_t entry = place + 9 + 6 + 16 * m;
        const size_t offset = number(bytes, entry + 8, 8);
        ASSERT_EQ(contained.at(offset), kMessage);
        EXPECT_EQ(number(contained, offset + 9 + 2 + 4, 8), number(bytes, entry, 8));
        ++num_found;
      }
    }
  }
  EXPECT_GT(num_chunks, 3);
  EXPECT_EQ(num_found, 60);
}

TEST_F(McapWriterTest, StatisticsCountTheMessages) {
  const std::string bytes = written(5, 10);
  for (const Record& record : records(bytes, 8, bytes.size() - 8)) {
    if (record.opcode != kStatistics) continue;
    EXPECT_EQ(number(record.content, 0, 8), 5u);
    EXPECT_EQ(number(record.content, 26, 8), 1'000'000u) << "first time, ns";
    EXPECT_EQ(number(record.content, 34, 8), 1'004'000u) << "last time, ns";
    EXPECT_EQ(number(record.content, 46 + 2, 8), 3u) << "messages of the first channel";
    return;
  }
  FAIL() << "no statistics";
}

TEST_F(McapWriterTest, NamesTheFileThatCannotBeWritten) {
  EXPECT_THROW(McapWriter("/no/such/folder/file.mcap"), Error);
  McapWriter full("/dev/full");
  const uint16_t channel = full.add_channel("A", full.add_schema("a", "{}"));
  full.add_message(channel, 0, "{}");
  EXPECT_THROW(full.finish(), Error);
}

}  // namespace
}  // namespace nao
