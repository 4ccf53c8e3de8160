// nao-motion-files
#include "daemons/motion-files/motion_files_program.h"

int main(int argc, char** argv) {
  return nao::motion_files::run_motion_files(argc, argv);
}
