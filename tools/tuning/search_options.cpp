#include "tools/tuning/search_options.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "common/command_line.h"
#include "common/program.h"

namespace nao {

std::string SearchOptions::checkpoint_file() const {
  if (!checkpoint.empty()) return checkpoint;
  return resume.empty() ? output + ".checkpoint" : resume;
}

std::map<std::string, std::string> SearchOptions::settings() const {
  return {{"--model", model},
          {"--population", std::to_string(population)},
          {"--sigma", fmt::format("{}", sigma)},
          {"--seed", std::to_string(seed)},
          {"--engine", fmt::format("{}", fmt::join(engines, ","))},
          {"--disturbances", fmt::format("{}", fmt::join(disturbances, ","))},
          {"--screen", std::to_string(screen)}};
}

void add_search_options(CommandLine& app, SearchOptions& options, const std::string& result,
                        const std::string& sigma_unit) {
  add_model_option(app, options.model);
  app.add_option("--output", options.output, "File for the tuned " + result);
  app.add_option("--generations", options.generations, "Generations of the search")->not_negative();
  app.add_option("--minutes", options.minutes,
                 "Time after which no further generation begins (0: no limit)")
      ->not_negative();
  app.add_option("--population", options.population, "Candidates in a generation")->range(4, 1000);
  app.add_option("--jobs", options.jobs,
                 "Threads (0: one for each core; in a process of mpirun one)")
      ->range(0, 1024);
  app.add_option("--sigma", options.sigma, "Initial standard deviation, " + sigma_unit)->positive();
  app.add_option("--seed", options.seed, "Seed of the search and of all trials");
  app.add_option("--engine", options.engines,
                 "Physics engines, NAME[,NAME...]: each candidate is evaluated with each of them")
      ->separated_by(',');
  app.add_option(
         "--disturbances", options.disturbances,
         "Disturbances, NAME[,NAME...]: each candidate is evaluated with each of them. NAME "
         "is a file of disturbances/, or entries of real such as backlash+floor_slope")
      ->separated_by(',');
  app.add_option("--screen", options.screen,
                 "Trials after which the worst third of the candidates is given up (0: never)")
      ->not_negative();
  app.add_option("--checkpoint", options.checkpoint,
                 "File for the state after each generation (default: OUTPUT.checkpoint)");
  app.add_option("--resume", options.resume,
                 "Continue from this checkpoint, with the same other options");
}

}  // namespace nao
