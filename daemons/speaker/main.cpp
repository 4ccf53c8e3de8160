// nao-speaker
#include "daemons/speaker/speaker_program.h"

int main(int argc, char** argv) {
  return nao::speaker::run_speaker(argc, argv);
}
