#pragma once

namespace nao::speaker {

/** nao-speaker: reads the command line and runs the program. Compiled with the daemon, for their
 * common headers take longer than the code.
 * @return exit status */
int run_speaker(int argc, char** argv);

}  // namespace nao::speaker
