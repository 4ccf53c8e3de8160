// nao-motion
#include "daemons/motion/motion_program.h"

int main(int argc, char** argv) {
  return nao::motion::run_motion(argc, argv);
}
