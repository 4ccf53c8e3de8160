#pragma once

#include <string>
#include <vector>

namespace nao {

/** One thing measured. */
struct Figure {
  /** "camera.soccer_ms". */
  std::string name;
  double value = 0;
  std::string unit;
  /** What it is held against in the same run, and that one's value; empty where there is none. */
  std::string peer;
  double peer_value = 0;
};

/** Middle value; the mean of both where their number is even. @param values  Not empty. */
double median(std::vector<double> values);

/** The value below which that share of the others lies, nearest rank; NaN for no values.
 * @param share  [0, 1]: 0.99 for the 99th percentile. */
double percentile(std::vector<double> values, double share);

/** The figures as a table for people. */
std::string to_table(const std::vector<Figure>& figures);

/** As an array of {"name", "value", "unit", "peer", "peer_value", "ratio"}; peer, its value and the
 * ratio value / peer_value are null where there is no peer, and so is every number that is not
 * finite. */
std::string to_json(const std::vector<Figure>& figures);

/** Prints the table, and writes the JSON to a file unless its name is empty.
 * @throws std::runtime_error  if the file cannot be written. */
void report(const std::vector<Figure>& figures, const std::string& json_file);

}  // namespace nao
