#include "tools/nao-tools/mcap_writer.h"

#include <algorithm>
#include <array>

namespace nao {
namespace {

// Opcodes of the specification's records.
constexpr uint8_t kHeader = 0x01;
constexpr uint8_t kFooter = 0x02;
constexpr uint8_t kSchema = 0x03;
constexpr uint8_t kChannel = 0x04;
constexpr uint8_t kMessage = 0x05;
constexpr uint8_t kChunk = 0x06;
constexpr uint8_t kMessageIndex = 0x07;
constexpr uint8_t kChunkIndex = 0x08;
constexpr uint8_t kStatistics = 0x0B;
constexpr uint8_t kSummaryOffset = 0x0E;
constexpr uint8_t kDataEnd = 0x0F;

// Beginning and end of a file (MCAP specification).
constexpr std::array<uint8_t, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
// Uncompressed size at which a chunk is closed, bytes. Readers load one chunk at a time; the value
// is of the order of the MCAP library's default (768 KiB).
constexpr size_t kChunkSize = 1 << 20;
// The specification lets a checksum of 0 mean that there is none.
constexpr uint32_t kNoChecksum = 0;

/** Builds a record's content: little-endian numbers; strings and maps are preceded by their size.
 */
class Content {
 public:
  template <class Number>
  Content& add(Number value) {
    for (size_t i = 0; i < sizeof(Number); ++i) {
      bytes_.push_back(static_cast<uint8_t>(static_cast<uint64_t>(value) >> (8 * i)));
    }
    return *this;
  }
  Content& add(const std::string& text) {
    add(static_cast<uint32_t>(text.size()));
    return add_raw({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  }
  Content& add_raw(std::span<const uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  const std::vector<uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<uint8_t> bytes_;
};

/** A record: opcode, size of the content, content. */
std::vector<uint8_t> record(uint8_t opcode, const std::vector<uint8_t>& content) {
  return Content().add(opcode).add(uint64_t{content.size()}).add_raw(content).bytes();
}

void append(std::vector<uint8_t>& bytes, const std::vector<uint8_t>& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& file) : file_(file) {
  write(kMagic);
  write_record(kHeader, Content().add(std::string()).add(std::string("nao-remote")).bytes());
}

uint16_t McapWriter::add_schema(const std::string& name, const std::string& json_schema) {
  const uint16_t number = ++num_schemas_;
  const auto bytes = record(
      kSchema,
      Content().add(number).add(name).add(std::string("jsonschema")).add(json_schema).bytes());
  append(schemas_, bytes);
  append(chunk_, bytes);
  return number;
}

uint16_t McapWriter::add_channel(const std::string& topic, uint16_t schema) {
  const auto number = static_cast<uint16_t>(num_messages_.size());
  num_messages_[number] = 0;
  const auto bytes = record(kChannel, Content()
                                          .add(number)
                                          .add(schema)
                                          .add(topic)
                                          .add(std::string("json"))
                                          .add(uint32_t{0})
                                          .bytes());
  append(channels_, bytes);
  append(chunk_, bytes);
  return number;
}

void McapWriter::add_message(uint16_t channel, int64_t wall_utime, const std::string& json) {
  const uint64_t time = static_cast<uint64_t>(std::max<int64_t>(0, wall_utime)) * 1000;
  const bool is_first = chunk_index_.empty();
  chunk_first_time_ = is_first ? time : std::min(chunk_first_time_, time);
  chunk_last_time_ = is_first ? time : std::max(chunk_last_time_, time);
  chunk_index_[channel].emplace_back(time, chunk_.size());
  ++num_messages_[channel];
  append(chunk_,
         record(kMessage, Content()
                              .add(channel)
                              .add(sequence_++)
                              .add(time)
                              .add(time)
                              .add_raw({reinterpret_cast<const uint8_t*>(json.data()), json.size()})
                              .bytes()));
  if (chunk_.size() >= kChunkSize) finish_chunk();
}

void McapWriter::finish_chunk() {
  if (chunk_index_.empty()) return;
  ChunkIndex index{chunk_first_time_, chunk_last_time_, offset_, 0, {}, 0, chunk_.size()};
  write_record(kChunk, Content()
                           .add(chunk_first_time_)
                           .add(chunk_last_time_)
                           .add(uint64_t{chunk_.size()})
                           .add(kNoChecksum)
                           .add(std::string())
                           .add(uint64_t{chunk_.size()})
                           .add_raw(chunk_)
                           .bytes());
  index.size = offset_ - index.offset;
  const uint64_t index_start = offset_;
  for (auto& [channel, messages] : chunk_index_) {
    std::stable_sort(messages.begin(), messages.end());
    index.index_offsets[channel] = offset_;
    Content content;
    content.add(channel).add(static_cast<uint32_t>(messages.size() * 16));
    for (const auto& [time, place] : messages) content.add(time).add(place);
    write_record(kMessageIndex, content.bytes());
  }
  index.index_size = offset_ - index_start;
  chunks_.push_back(std::move(index));
  chunk_.clear();
  chunk_index_.clear();
}

void McapWriter::finish() {
  finish_chunk();
  write_record(kDataEnd, Content().add(kNoChecksum).bytes());
  write_summary();
  write(kMagic);
  file_.finish();
}

void McapWriter::write_summary() {
  const uint64_t start = offset_;
  write(schemas_);
  const uint64_t channels_start = offset_;
  write(channels_);
  const uint64_t statistics_start = offset_;
  uint64_t first = 0;
  uint64_t last = 0;
  for (const ChunkIndex& chunk : chunks_) {
    first = &chunk == &chunks_.front() ? chunk.first_time : std::min(first, chunk.first_time);
    last = std::max(last, chunk.last_time);
  }
  Content statistics;
  statistics.add(uint64_t{sequence_})
      .add(num_schemas_)
      .add(static_cast<uint32_t>(num_messages_.size()))
      .add(uint32_t{0})  // attachments
      .add(uint32_t{0})  // metadata
      .add(static_cast<uint32_t>(chunks_.size()))
      .add(first)
      .add(last)
      .add(static_cast<uint32_t>(num_messages_.size() * 10));
  for (const auto& [channel, count] : num_messages_) statistics.add(channel).add(count);
  write_record(kStatistics, statistics.bytes());
  const uint64_t chunks_start = offset_;
  for (const ChunkIndex& chunk : chunks_) {
    Content content;
    content.add(chunk.first_time).add(chunk.last_time).add(chunk.offset).add(chunk.size);
    content.add(static_cast<uint32_t>(chunk.index_offsets.size() * 10));
    for (const auto& [channel, place] : chunk.index_offsets) content.add(channel).add(place);
    content.add(chunk.index_size).add(std::string()).add(chunk.num_bytes).add(chunk.num_bytes);
    write_record(kChunkIndex, content.bytes());
  }
  const uint64_t offsets_start = offset_;
  const auto group = [this](uint8_t opcode, uint64_t from, uint64_t to) {
    if (from == to) return;
    write_record(kSummaryOffset, Content().add(opcode).add(from).add(to - from).bytes());
  };
  group(kSchema, start, channels_start);
  group(kChannel, channels_start, statistics_start);
  group(kStatistics, statistics_start, chunks_start);
  group(kChunkIndex, chunks_start, offsets_start);
  write_record(kFooter, Content().add(start).add(offsets_start).add(kNoChecksum).bytes());
}

void McapWriter::write_record(uint8_t opcode, const Bytes& content) {
  write(record(opcode, content));
}

void McapWriter::write(std::span<const uint8_t> bytes) {
  file_.stream().write(reinterpret_cast<const char*>(bytes.data()),
                       static_cast<std::streamsize>(bytes.size()));
  offset_ += bytes.size();
}

}  // namespace nao
