// nao-head-camera
#include "daemons/head-camera/head_camera_program.h"

int main(int argc, char** argv) {
  return nao::camera::run_head_camera(argc, argv);
}
