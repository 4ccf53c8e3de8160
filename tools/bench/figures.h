#pragma once

#include <string>
#include <vector>

namespace nao {

/** One measured quantity. */
struct Figure {
  /** "camera.soccer_ms". */
  std::string name;
  double value = 0;
  std::string unit;
  /** Baseline measured in the same run and its value; empty if there is none. */
  std::string baseline;
  double baseline_value = 0;
};

/** Median; the mean of the two middle values of an even number. @param values  Not empty. */
double median(std::vector<double> values);

/** Quantile by nearest rank; NaN for no values.
 * @param fraction  [0, 1]: 0.99 for the 99th percentile. */
double percentile(std::vector<double> values, double fraction);

/** The figures as a text table. */
std::string to_table(const std::vector<Figure>& figures);

/** JSON array of {"name", "value", "unit", "baseline", "baseline_value", "ratio"} with ratio =
 * value / baseline_value. The last three are null without a baseline; non-finite numbers are null.
 */
std::string to_json(const std::vector<Figure>& figures);

}  // namespace nao
