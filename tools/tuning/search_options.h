#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace nao {

class CommandLine;

/** Options of the tuners' seeded search. */
struct SearchOptions {
  std::string model = "nao";
  std::string output;
  int generations = 30;
  /** Time after which no further generation begins, minutes; 0: no limit. */
  double minutes = 0;
  int population = 14;
  /** Threads of this process; 0: all cores, or one where mpirun started it. */
  int jobs = 0;
  /** Initial standard deviation, in units of the tuner's parameters. */
  double sigma = 0.05;
  uint64_t seed = 1;
  /** Every candidate is evaluated with each engine and each set of disturbances. */
  std::vector<std::string> engines = {"fast"};
  std::vector<std::string> disturbances = {"default"};
  /** Trials after which the worst third of the candidates is given up; 0: none is. */
  int screen = 0;
  /** File of the checkpoint; empty: `output` with ".checkpoint". */
  std::string checkpoint{};
  /** Checkpoint to continue from; empty: begin. */
  std::string resume{};

  std::string checkpoint_file() const;
  /** Everything that decides the result of a search, by option, except the model's files. */
  std::map<std::string, std::string> settings() const;
};

/** Adds the options above to a command line.
 * @param result      Content of --output: "gait".
 * @param sigma_unit  Unit of --sigma. */
void add_search_options(CommandLine& app, SearchOptions& options, const std::string& result,
                        const std::string& sigma_unit);

}  // namespace nao
