#pragma once

#include <functional>
#include <vector>

#include "common/command_line.h"
#include "tools/bench/figures.h"

namespace nao {

/** Runs a benchmark: adds --json to its options, parses the command line, prints the figures that
 * `measure` returns as a table, and writes them to the file of --json.
 * @return Exit status: 0 measured (or --help), 1 `measure` threw, 2 the command line is wrong. */
int run_benchmark(CommandLine& app, int argc, char** argv,
                  const std::function<std::vector<Figure>()>& measure);

}  // namespace nao
