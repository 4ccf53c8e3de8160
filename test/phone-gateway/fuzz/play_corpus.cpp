// Runs a fuzzer's entry point on a pack of stored inputs (see corpus.py), without libFuzzer and
// with any compiler. Usage: play_corpus PACK
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "phone-gateway/protocol/framing.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int main(int argc, char** argv) {
  constexpr size_t kMaxInputBytes = 1 << 20;
  std::ifstream file(argc == 2 ? argv[1] : "", std::ios::binary);
  nao::FrameReader reader(kMaxInputBytes);
  reader.add(std::string(std::istreambuf_iterator<char>(file), {}));
  int num_inputs = 0;
  while (const auto input = reader.next()) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(input->data()), input->size());
    ++num_inputs;
  }
  std::cout << num_inputs << " inputs\n";
  const bool is_whole = num_inputs > 0 && reader.num_waiting_bytes() == 0;
  if (!is_whole)
    std::cerr << "not a pack of inputs: " << (argc == 2 ? argv[1] : "no file given") << "\n";
  return is_whole ? 0 : 1;
}
