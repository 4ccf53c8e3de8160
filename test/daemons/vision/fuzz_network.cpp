// Fuzzer of what reads a network's file: the project's own file with changed layers, or any bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "common/data_path.h"
#include "common/error.h"
#include "daemons/vision/layer_graph.h"
#include "onnx.pb.h"

namespace {

namespace onnx = nao::vision::onnx;

/** An image so small that thousands of networks a second are computed. */
constexpr int kSize = 16;

onnx::Model read_ball_network() {
  onnx::Model model;
  std::ifstream file(nao::data_path() / "networks/ball.onnx", std::ios::binary);
  if (!model.ParseFromIstream(&file)) std::abort();
  return model;
}

/** Changes one thing. Each parameter is any byte. */
void change(onnx::Graph& graph, uint8_t what, uint8_t where, uint8_t entry, uint8_t value) {
  if (graph.node().empty() || graph.initializer().empty()) return;
  onnx::Node& node = *graph.mutable_node(where % graph.node_size());
  onnx::Tensor& tensor = *graph.mutable_initializer(where % graph.initializer_size());
  const onnx::Node& other = graph.node(entry % graph.node_size());
  switch (what % 8) {
    case 0:
      if (!tensor.dims().empty()) tensor.set_dims(entry % tensor.dims_size(), int64_t{value} - 2);
      break;
    case 1:
      tensor.mutable_raw_data()->resize(size_t{4} * value);
      break;
    case 2:
      if (node.attribute().empty()) break;
      for (auto& number : *node.mutable_attribute(entry % node.attribute_size())->mutable_ints()) {
        number = int64_t{value} - 2;
      }
      break;
    case 3:
      if (!node.input().empty() && !other.output().empty()) {
        node.set_input(value % node.input_size(), other.output(0));
      }
      break;
    case 4:
      node.set_op_type(other.op_type());
      break;
    case 5:
      graph.mutable_node()->SwapElements(where % graph.node_size(), entry % graph.node_size());
      break;
    case 6:
      graph.mutable_node()->DeleteSubrange(where % graph.node_size(), 1);
      break;
    default:
      *graph.add_node() = other;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const onnx::Model ball_network = read_ball_network();
  std::string bytes(reinterpret_cast<const char*>(data), size);
  if (size % 2 == 0) {
    onnx::Model model = ball_network;
    for (size_t i = 0; i + 4 <= size; i += 4) {
      change(*model.mutable_graph(), data[i], data[i + 1], data[i + 2], data[i + 3]);
    }
    bytes = model.SerializeAsString();
  }
  try {
    std::istringstream file(bytes);
    nao::vision::LayerGraph layers(file, kSize, kSize);
    layers.run();
    std::vector<float> output(
        static_cast<size_t>(layers.num_outputs() * layers.output_rows() * layers.output_columns()));
    layers.copy_output(output.data());
  } catch (const nao::Error&) {
    return 0;
  }
  return 0;
}
