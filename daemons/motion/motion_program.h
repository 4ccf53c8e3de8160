#pragma once

namespace nao::motion {

/** nao-motion: reads the command line and runs the program. Compiled with the daemon, for their
 * common headers take longer than the code.
 * @return exit status */
int run_motion(int argc, char** argv);

}  // namespace nao::motion
