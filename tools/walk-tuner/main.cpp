#include "common/command_line.h"
#include "common/data_path.h"
#include "common/program.h"
#include "tools/walk-tuner/tune_gait.h"

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Tunes a robot's gait in simulation. A seeded search (CMA-ES) varies the parameters of the "
      "gait file within their ranges. Each candidate is evaluated by walks with disturbances and "
      "pushes. The result is written after every generation; equal seeds give equal results, with "
      "any "
      "number of threads and, under mpirun, of processes.",
      "nao-walk-tuner");
  nao::CommonOptions common;
  nao::add_log_option(app, common);
  nao::tool::TunerOptions options;
  nao::add_search_options(app, options.search, "gait", "fraction of the parameters' ranges");
  app.add_option("--gait", options.gait_file, "Gait file to start from (default: the robot's)");
  app.add_option("--set", options.settings, "GROUP.KEY=NUMBER in place of the file's value");
  app.add_option("--only", options.only,
                 "Parameters to tune, GROUP.KEY (default: all but limits, foot_separation, arms, "
                 "kick and standing)");
  app.add_option("--courses", options.courses,
                 "Courses of ten walks for each candidate, engine and set of disturbances")
      ->positive();
  app.add_option("--speed", options.speed, "Commanded fraction of the robot's walk limits")
      ->positive();
  app.add_option("--late", options.late_probability,
                 "Probability that the motion core misses a tick and up to three more")
      ->range(0.0, 1.0);
  app.add_flag("--check", options.is_check, "Only evaluate the gait, on --courses courses");
  return nao::run_program(app, common, argc, argv, [&] {
    options.folder = nao::data_path() / "robots" / options.search.model;
    nao::tool::tune_gait(options);
  });
}
