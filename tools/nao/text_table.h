#pragma once

#include <string>
#include <vector>

namespace nao {

/** Formats rows of text as columns, two spaces apart, each as wide as its longest cell. Cells that
 * begin with a digit, a sign or a dot are right-aligned, others left-aligned.
 * @param rows  The first is the heading; all have the same number of cells. */
std::string format_table(const std::vector<std::vector<std::string>>& rows);

/** A number with a fixed count of decimals; "-" if it is not finite. */
std::string format_number(double value, int num_decimals);

}  // namespace nao
