#include "tools/nao/text_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace nao {
namespace {

/** Columns that a terminal needs for UTF-8 text: one for each character. */
size_t width_of(const std::string& text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
}

bool is_number_like(const std::string& cell) {
  return !cell.empty() && std::string("0123456789+-.").find(cell[0]) != std::string::npos;
}

}  // namespace

std::string format_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string result;
  for (size_t r = 0; r < rows.size(); ++r) {
    std::string line;
    for (size_t i = 0; i < rows[r].size(); ++i) {
      const std::string& cell = rows[r][i];
      const std::string padding(widths[i] - width_of(cell), ' ');
      // A heading stands as the cells below it do.
      const bool is_right = is_number_like(r == 0 && rows.size() > 1 ? rows[1][i] : cell);
      if (i > 0) line += "  ";
      line += is_right ? padding + cell : cell + padding;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + "\n";
  }
  return result;
}

std::string format_number(double value, int num_decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, num_decimals) : "-";
}

}  // namespace nao
