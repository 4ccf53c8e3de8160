// Writes the URDFs of ten humanoids of random dimensions, and prints their dimensions:
// tune_humanoids.py makes them walk.

#include <cmath>
#include <iostream>
#include <random>

#include "test/support/test_biped.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "Usage: make_humanoids FOLDER\n"
                 "Writes FOLDER/humanoid0.urdf to humanoid9.urdf. Prints for each a line: number, "
                 "length of the leg from hip to ankle, m, mass, kg, axes of the hip from the root, "
                 "1 with a waist, 1 with a leg that has no closed form.\n";
    return 2;
  }
  std::mt19937 random(nao::kHumanoidsSeed);
  for (int i = 0; i < nao::kNumHumanoids; ++i) {
    const nao::TestBiped biped = nao::random_biped(random);
    const std::filesystem::path file =
        std::filesystem::path(argv[1]) / ("humanoid" + std::to_string(i) + ".urdf");
    nao::write_text(file, nao::make_biped_urdf(biped));
    const double leg = 2 * biped.hip_offset + biped.thigh + biped.shank;
    std::cout << i << ' ' << leg << ' ' << biped.mass << ' ' << biped.hip << ' ' << biped.has_waist
              << ' ' << (biped.hip_offset > 0) << '\n';
  }
  return 0;
}
