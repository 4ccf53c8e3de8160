#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace nao {

class CommandLine;

/** Options of the tuners' seeded search. */
struct SearchOptions {
  std::string model = "nao";
  std::string output;
  int generations = 30;
  int population = 14;
  int jobs = 1;
  /** Initial standard deviation, in units of the tuner's parameters. */
  double sigma = 0.05;
  uint64_t seed = 1;
};

/** Adds --model, --output, --generations, --population, --jobs, --sigma and --seed.
 * @param result      Content of --output: "gait".
 * @param sigma_unit  Unit of --sigma. */
void add_search_options(CommandLine& app, SearchOptions& options, const std::string& result,
                        const std::string& sigma_unit);

/** Calls `work` once for every index below `count`, on `jobs` threads, in unspecified order;
 * returns when all calls have returned. `work` must be thread-safe. */
void for_each_index(size_t count, int jobs, const std::function<void(size_t)>& work);

/** @throws Error  if the file cannot be read. */
std::string read_text(const std::filesystem::path& file);

/** @throws Error  if the file cannot be written. */
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace nao
