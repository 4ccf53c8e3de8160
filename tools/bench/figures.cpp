#include "tools/bench/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace nao {
namespace {

std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<size_t>(std::lround(share * last))];
}

std::string to_table(const std::vector<Figure>& figures) {
  std::string table;
  std::array<char, 200> line{};
  for (const Figure& figure : figures) {
    std::snprintf(line.data(), line.size(), "%-36s %12.6g %-8s", figure.name.c_str(), figure.value,
                  figure.unit.c_str());
    table += line.data();
    if (!figure.peer.empty()) {
      std::snprintf(line.data(), line.size(), " %s: %.6g, ratio %.3g", figure.peer.c_str(),
                    figure.peer_value, figure.value / figure.peer_value);
      table += line.data();
    }
    table += "\n";
  }
  return table;
}

std::string to_json(const std::vector<Figure>& figures) {
  std::string json = "[";
  for (const Figure& figure : figures) {
    const bool has_peer = !figure.peer.empty();
    json += json == "[" ? "\n" : ",\n";
    json += "  {\"name\": \"" + figure.name + "\", \"value\": " + number(figure.value) +
            ", \"unit\": \"" + figure.unit +
            "\", \"peer\": " + (has_peer ? "\"" + figure.peer + "\"" : "null") +
            ", \"peer_value\": " + (has_peer ? number(figure.peer_value) : "null") +
            ", \"ratio\": " + (has_peer ? number(figure.value / figure.peer_value) : "null") + "}";
  }
  return json + "\n]\n";
}

void report(const std::vector<Figure>& figures, const std::string& json_file) {
  std::cout << to_table(figures) << std::flush;
  if (json_file.empty()) return;
  std::ofstream file(json_file);
  file << to_json(figures);
  file.close();
  if (!file) throw std::runtime_error("cannot write " + json_file);
}

}  // namespace nao
