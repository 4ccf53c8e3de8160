// Plays a pack of kept inputs (see corpus.py) to a fuzzer's entry, without libFuzzer: what once was
// interesting stays harmless, with every compiler. Usage: play_corpus PACK
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
  if (!is_whole) std::cerr << "no pack of inputs: " << (argc == 2 ? argv[1] : "none named") << "\n";
  return is_whole ? 0 : 1;
}
