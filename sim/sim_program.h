#pragma once

namespace nao::sim {

/** nao-sim: reads the command line and runs the program. Compiled with the daemon, for their common
 * headers take longer than the code.
 * @return exit status */
int run_sim(int argc, char** argv);

}  // namespace nao::sim
