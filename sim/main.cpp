// nao-sim
#include "sim/sim_program.h"

int main(int argc, char** argv) {
  return nao::sim::run_sim(argc, argv);
}
