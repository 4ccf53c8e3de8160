#include "tools/tuning/search.h"

#include <atomic>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

#include "common/command_line.h"
#include "common/error.h"

namespace nao {

void add_search_options(CommandLine& app, SearchOptions& options, const std::string& result,
                        const std::string& sigma_unit) {
  app.add_option("--model", options.model, "Folder of robots/ that describes the robot")
      ->show_default();
  app.add_option("--output", options.output, "File for the tuned " + result)->show_default();
  app.add_option("--generations", options.generations, "Generations of the search")->show_default();
  app.add_option("--population", options.population, "Candidates in a generation")
      ->range(4, 1000)
      ->show_default();
  app.add_option("--jobs", options.jobs, "Threads")->range(1, 256)->show_default();
  app.add_option("--sigma", options.sigma, "Initial standard deviation, " + sigma_unit)
      ->positive()
      ->show_default();
  app.add_option("--seed", options.seed, "Seed of the search and of all trials")->show_default();
}

void for_each_index(size_t count, int jobs, const std::function<void(size_t)>& work) {
  std::atomic<size_t> next = 0;
  const auto run = [&] {
    for (size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < jobs; ++i) helpers.emplace_back(run);
  run();
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  if (!stream) throw Error("cannot read " + file.string());
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text << std::flush;
  if (!stream) throw Error("cannot write " + file.string());
}

}  // namespace nao
