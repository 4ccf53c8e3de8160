#pragma once

namespace nao::camera {

/** nao-head-camera: reads the command line and runs the program. Compiled with the daemon, for
 * their common headers take longer than the code.
 * @return exit status */
int run_head_camera(int argc, char** argv);

}  // namespace nao::camera
