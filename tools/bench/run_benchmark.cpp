#include "tools/bench/run_benchmark.h"

#include <iostream>
#include <string>

#include "common/output_file.h"
#include "common/program.h"

namespace nao {

int run_benchmark(CommandLine& app, int argc, char** argv,
                  const std::function<std::vector<Figure>()>& measure) {
  std::string json_file;
  app.add_option("--json", json_file, "Write the figures to this file too");
  CommonOptions common;
  common.log_level = "warning";
  return run_program(app, common, argc, argv, [&] {
    const std::vector<Figure> figures = measure();
    std::cout << to_table(figures) << std::flush;
    if (!json_file.empty()) replace_file(json_file, to_json(figures));
  });
}

}  // namespace nao
