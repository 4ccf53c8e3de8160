#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/tuning/search_options.h"

namespace nao::tool {

/** Options of the search for a gait. */
struct TunerOptions {
  SearchOptions search = {
      .output = "gait.yaml", .generations = 30, .population = 14, .sigma = 0.05};
  /** Folder of the robot. */
  std::filesystem::path folder;
  /** Gait to start from; empty: the robot's. */
  std::string gait_file;
  /** Parameters to tune, GROUP.KEY; empty: all that a search improves. */
  std::vector<std::string> only;
  /** GROUP.KEY=NUMBER in place of the file's value. */
  std::vector<std::string> settings;
  int courses = 1;
  /** Commanded fraction of the robot's walk limits. */
  double speed = 1;
  double late_probability = 0.01;
  /** Only evaluate the gait. */
  bool is_check = false;
};

/** Searches a better gait for a robot, and writes it and the search's state after each generation.
 * @throws ConfigError  naming a wrong option. @throws Error  if a file cannot be read or written.
 */
void tune_gait(const TunerOptions& options);

}  // namespace nao::tool
