#pragma once

#include <filesystem>
#include <memory>
#include <vector>

namespace nao {

/** A function from observations to actions. */
class PolicyNetwork {
 public:
  virtual ~PolicyNetwork() = default;

  /** @param action  Receives the outputs; they may be not finite.
   * @return Processor time that it took, s. */
  virtual double run(const std::vector<float>& observation, std::vector<float>& action) = 0;
};

/** Reads an ONNX file; OpenCV runs it. Its input is 1 x num_observations, its output has
 * num_actions numbers. A network with a memory (LSTM, GRU) is refused: OpenCV forgets the memory
 * after each run.
 * @throws ModelError  with the file and what is wrong: it is missing, is no ONNX file that this
 * OpenCV can read, or has other numbers of inputs or outputs. */
std::unique_ptr<PolicyNetwork> load_policy_network(const std::filesystem::path& file,
                                                   int num_observations, int num_actions);

}  // namespace nao
