#include "tools/bench/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/json_writer.h"

namespace nao {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<size_t>(std::lround(fraction * last))];
}

std::string to_table(const std::vector<Figure>& figures) {
  std::string table;
  std::array<char, 200> line{};
  for (const Figure& figure : figures) {
    std::snprintf(line.data(), line.size(), "%-36s %12.6g %-8s", figure.name.c_str(), figure.value,
                  figure.unit.c_str());
    table += line.data();
    if (!figure.baseline.empty()) {
      std::snprintf(line.data(), line.size(), " %s: %.6g, ratio %.3g", figure.baseline.c_str(),
                    figure.baseline_value, figure.value / figure.baseline_value);
      table += line.data();
    }
    table += "\n";
  }
  return table;
}

std::string to_json(const std::vector<Figure>& figures) {
  JsonWriter json;
  json.begin_array();
  for (const Figure& figure : figures) {
    json.begin_object();
    json.add("name", figure.name);
    json.add("value", figure.value);
    json.add("unit", figure.unit);
    if (figure.baseline.empty()) {
      for (const char* key : {"baseline", "baseline_value", "ratio"}) json.add_null(key);
    } else {
      json.add("baseline", figure.baseline);
      json.add("baseline_value", figure.baseline_value);
      json.add("ratio", figure.value / figure.baseline_value);
    }
    json.end();
  }
  return json.take() + "\n";
}

}  // namespace nao
