#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/output_file.h"

namespace nao {

/** Writes an MCAP file of JSON messages with JSON schemas, for Foxglove and PlotJuggler.
 * Implemented here because Debian 12 has no package of the MCAP library.
 *
 * Format: https://mcap.dev/spec: chunks without compression, an index of each, statistics. */
class McapWriter {
 public:
  /** @throws Error  if the file cannot be written. */
  explicit McapWriter(const std::filesystem::path& file);

  /** @return Number of the schema, for add_channel(). */
  uint16_t add_schema(const std::string& name, const std::string& json_schema);
  /** @return Number of the channel, for add_message(). */
  uint16_t add_channel(const std::string& topic, uint16_t schema);
  /** @param wall_utime  Time of reception, microseconds since 1970. */
  void add_message(uint16_t channel, int64_t wall_utime, const std::string& json);

  /** Writes the index and closes the file.
   * @throws Error  if the file could not be written completely, such as on a full disk. */
  void finish();

 private:
  using Bytes = std::vector<uint8_t>;
  struct ChunkIndex {
    uint64_t first_time;
    uint64_t last_time;
    uint64_t offset;
    uint64_t size;
    /** Offset of each channel's index. */
    std::map<uint16_t, uint64_t> index_offsets;
    uint64_t index_size;
    uint64_t num_bytes;
  };

  void write_record(uint8_t opcode, const Bytes& content);
  void write(std::span<const uint8_t> bytes);
  void finish_chunk();
  void write_summary();

  OutputFile file_;
  uint64_t offset_ = 0;

  Bytes schemas_;
  uint16_t num_schemas_ = 0;
  Bytes channels_;
  std::map<uint16_t, uint64_t> num_messages_;
  uint32_t sequence_ = 0;

  Bytes chunk_;
  uint64_t chunk_first_time_ = 0;
  uint64_t chunk_last_time_ = 0;
  /** For each channel, time and offset in the chunk of its messages. */
  std::map<uint16_t, std::vector<std::pair<uint64_t, uint64_t>>> chunk_index_;
  std::vector<ChunkIndex> chunks_;
};

}  // namespace nao
