#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "test/support/temporary_folder.h"

namespace nao {

/** A fully connected layer and what follows it. */
struct OnnxLayer {
  /** outputs x inputs, row by row; and one bias for each output. */
  std::vector<float> weight;
  std::vector<float> bias;
  /** "Elu", "Relu", "Tanh"; empty: none. */
  std::string activation;
};

/** Bytes of an ONNX file, written field by field (https://github.com/onnx/onnx, onnx.proto3). */
class OnnxFile {
 public:
  /** @param num_inputs  Of the first layer. @param opset  As torch.onnx.export has it. */
  static void write(const std::filesystem::path& file, int num_inputs,
                    const std::vector<OnnxLayer>& layers, int opset = 11) {
    std::string graph;
    std::string tensors;
    std::string name = "obs";
    auto size = static_cast<uint64_t>(num_inputs);
    for (size_t k = 0; k < layers.size(); ++k) {
      const OnnxLayer& layer = layers[k];
      const std::string id = std::to_string(k);
      const uint64_t outputs = layer.bias.size();
      tensors += data(5, tensor(id + ".weight", {outputs, size}, layer.weight));
      tensors += data(5, tensor(id + ".bias", {outputs}, layer.bias));
      const bool is_last = k + 1 == layers.size();
      const bool is_active = !layer.activation.empty();
      std::string output = is_last && !is_active ? "actions" : id + ".gemm";
      const std::string transposed = data(5, data(1, "transB") + number(3, 1) + number(20, 2));
      graph += data(1, node("Gemm", {name, id + ".weight", id + ".bias"}, output, transposed));
      if (is_active) {
        const std::string active = is_last ? "actions" : id + ".active";
        graph += data(1, node(layer.activation, {output}, active, ""));
        output = active;
      }
      name = output;
      size = outputs;
    }
    graph += data(2, "main_graph") + tensors;
    graph += data(11, value("obs", static_cast<uint64_t>(num_inputs))) +
             data(12, value("actions", size));
    write_text(file, number(1, 7) + data(7, graph) +
                         data(8, data(1, "") + number(2, static_cast<uint64_t>(opset))));
  }

  /** A layer whose outputs are `bias`, whatever goes in. */
  static OnnxLayer constant(int num_inputs, const std::vector<float>& bias) {
    return {std::vector<float>(bias.size() * static_cast<size_t>(num_inputs)), bias, ""};
  }

 private:
  static std::string varint(uint64_t value) {
    std::string bytes;
    for (; value > 0x7F; value >>= 7) bytes += static_cast<char>((value & 0x7F) | 0x80);
    return bytes + static_cast<char>(value);
  }
  static std::string number(uint64_t field, uint64_t value) {
    return varint(field << 3) + varint(value);
  }
  static std::string data(uint64_t field, const std::string& bytes) {
    return varint(field << 3 | 2) + varint(bytes.size()) + bytes;
  }
  static std::string node(const std::string& kind, const std::vector<std::string>& inputs,
                          const std::string& output, const std::string& attributes) {
    std::string bytes;
    for (const std::string& input : inputs) bytes += data(1, input);
    return bytes + data(2, output) + data(3, output) + data(4, kind) + attributes;
  }
  static std::string tensor(const std::string& name, const std::vector<uint64_t>& shape,
                            const std::vector<float>& numbers) {
    std::string bytes;
    for (const uint64_t size : shape) bytes += number(1, size);
    std::string raw(numbers.size() * sizeof(float), '\0');
    std::memcpy(raw.data(), numbers.data(), raw.size());
    return bytes + number(2, 1) + data(8, name) + data(9, raw);
  }
  static std::string value(const std::string& name, uint64_t size) {
    const std::string shape = data(1, number(1, 1)) + data(1, number(1, size));
    return data(1, name) + data(2, data(1, number(1, 1) + data(2, shape)));
  }
};

}  // namespace nao
