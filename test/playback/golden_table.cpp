#include "test/playback/golden_table.h"

#include <fstream>
#include <iterator>
#include <sstream>

#include "common/error.h"

namespace nao::playback {
namespace {

/** Reads zigzag varints from bytes. */
class VarintReader {
 public:
  VarintReader(const std::string& bytes, size_t offset) : bytes_(bytes), offset_(offset) {}

  bool is_at_end() const { return offset_ == bytes_.size(); }

  /** @return false at the end of the bytes. */
  bool read(int64_t& value) {
    uint64_t bits = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      if (is_at_end()) return false;
      const auto byte = static_cast<uint8_t>(bytes_[offset_++]);
      bits |= static_cast<uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) {
        value = static_cast<int64_t>(bits >> 1) ^ -static_cast<int64_t>(bits & 1);
        return true;
      }
    }
    return false;
  }

 private:
  const std::string& bytes_;
  size_t offset_;
};

}  // namespace

GoldenTable::GoldenTable(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const auto fail = [&](const std::string& why) { throw Error(file.string() + ": " + why); };
  if (!stream || text.empty()) fail("cannot be read");

  std::istringstream header(text);
  std::string line;
  if (!std::getline(header, line) || line != "golden table 1") fail("is not a golden table");
  while (std::getline(header, line) && line != "data") {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "rows") {
      words >> num_rows_;
    } else if (key == "column") {
      GoldenColumn column;
      std::string resolution;
      words >> column.quantity >> column.name >> resolution;
      column.resolution = std::strtod(resolution.c_str(), nullptr);
      columns_.push_back(column);
    }
    if (words.fail()) fail("has a header line that cannot be read: " + line);
  }
  if (!header || columns_.empty()) fail("has no data");

  VarintReader reader(text, static_cast<size_t>(header.tellg()));
  std::vector<int64_t> multiples(columns_.size(), 0);
  for (size_t row = 0; row < num_rows_; ++row) {
    for (size_t i = 0; i < columns_.size(); ++i) {
      int64_t change = 0;
      if (!reader.read(change)) fail("is cut off in row " + std::to_string(row));
      multiples[i] += change;
      values_.push_back(static_cast<double>(multiples[i]) * columns_[i].resolution);
    }
  }
  if (!reader.is_at_end()) fail("has bytes behind its last row");
}

std::vector<std::string> GoldenTable::names(const std::string& quantity) const {
  std::vector<std::string> names;
  for (const GoldenColumn& column : columns_) {
    if (column.quantity == quantity) names.push_back(column.name);
  }
  return names;
}

std::vector<double> GoldenTable::values(size_t row, const std::string& quantity) const {
  std::vector<double> values;
  for (size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].quantity == quantity) values.push_back(values_[row * columns_.size() + i]);
  }
  return values;
}

int64_t GoldenTable::tick(size_t row) const {
  return static_cast<int64_t>(values(row, "tick").at(0));
}

}  // namespace nao::playback
