#include "daemons/vision/layer_graph.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "common/error.h"
#include "onnx.pb.h"

namespace nao::vision {
namespace {

/** Limits of what a file may ask for; the networks stay far below. */
constexpr int64_t kMostChannels = 1024;
constexpr int64_t kMostKernel = 16;
constexpr int64_t kMostStep = 16;

[[noreturn]] void refuse(const onnx::Node& node, const std::string& problem) {
  throw Error("layer " + (node.output_size() > 0 ? node.output(0) : "") + " (" + node.op_type() +
              ") " + problem);
}

const onnx::Attribute* find_attribute(const onnx::Node& node, const std::string& name) {
  for (const onnx::Attribute& attribute : node.attribute()) {
    if (attribute.name() == name) return &attribute;
  }
  return nullptr;
}

/** The number that all entries of an attribute have, `without` if it is missing. */
int equal_entries(const onnx::Node& node, const std::string& name, int without, int64_t least,
                  int64_t most) {
  const onnx::Attribute* attribute = find_attribute(node, name);
  if (attribute == nullptr || attribute->ints().empty()) return without;
  const int64_t number = attribute->ints(0);
  const bool are_equal = std::all_of(attribute->ints().begin(), attribute->ints().end(),
                                     [&](int64_t other) { return other == number; });
  if (!are_equal || number < least || number > most) {
    refuse(node, "has " + name + " that differ or are not from " + std::to_string(least) + " to " +
                     std::to_string(most));
  }
  return static_cast<int>(number);
}

/** The numbers of a tensor, of which there must be `count`. */
std::vector<float> numbers_of(const onnx::Node& node, const onnx::Tensor& tensor, size_t count) {
  if (tensor.data_type() != 1 || tensor.raw_data().size() != count * sizeof(float)) {
    refuse(node, "has other numbers than its shape needs");
  }
  std::vector<float> numbers(count);
  std::memcpy(numbers.data(), tensor.raw_data().data(), count * sizeof(float));
  return numbers;
}

}  // namespace

LayerGraph::LayerGraph(std::istream& file, int rows, int columns) {
  onnx::Model model;
  if (!model.ParseFromIstream(&file)) throw Error("the file is damaged");
  const onnx::Graph& graph = model.graph();
  if (graph.input_size() != 1 || graph.output_size() != 1) {
    throw Error("it has not one input and one output");
  }
  Tensors tensors;
  for (const onnx::Tensor& tensor : graph.initializer()) tensors[tensor.name()] = &tensor;
  values_.push_back({rows, columns, 3, 0, {}});
  names_[graph.input(0).name()] = {0, 3};
  for (const onnx::Node& node : graph.node()) add(node, tensors);
  if (outputs_.empty()) outputs_ = {find(graph.output(0).name())};
  names_.clear();
  for (const Named& output : outputs_) {
    const Activations& value = values_[output.value];
    if (output.scale != 1 || value.rows != output_rows() || value.columns != output_columns()) {
      throw Error("its outputs have different sizes");
    }
  }
  for (Activations& value : values_) value.allocate();
}

void LayerGraph::add(const onnx::Node& node, Tensors& tensors) {
  const std::string& kind = node.op_type();
  if (node.output_size() != 1) refuse(node, "has not one output");
  if (!outputs_.empty()) refuse(node, "follows the output");
  if (kind == "Constant") {
    if (const auto* value = find_attribute(node, "value")) tensors[node.output(0)] = &value->t();
    return;
  }
  if (node.input_size() < 1) refuse(node, "has no input");
  if (kind == "Conv") {
    add_convolution(node, tensors);
  } else if (kind == "Add") {
    add_sum(node);
  } else if (kind == "Relu") {
    const Named input = find(node.input(0));
    if (layers_.empty() || layers_.back().output != input.value || input.scale != 1) {
      refuse(node, "does not follow a convolution or an addition");
    }
    layers_.back().is_rectified = true;
    // From now on the value is rectified.
    names_.erase(node.input(0));
    names_[node.output(0)] = input;
  } else if (kind == "Resize") {
    Named input = find(node.input(0));
    const auto scales = tensors.find(node.input_size() > 2 ? node.input(2) : "");
    const auto* mode = find_attribute(node, "mode");
    if (scales == tensors.end() || input.scale != 1 || mode == nullptr || mode->s() != "nearest" ||
        numbers_of(node, *scales->second, 4) != std::vector<float>{1, 1, 2, 2}) {
      refuse(node, "does not double rows and columns");
    }
    input.scale = 2;
    names_[node.output(0)] = input;
  } else if (kind == "Concat") {
    for (const std::string& name : node.input()) outputs_.push_back(find(name));
  } else {
    refuse(node, "is of an unknown kind");
  }
}

const LayerGraph::Named& LayerGraph::find(const std::string& name) const {
  const auto found = names_.find(name);
  if (found == names_.end()) throw Error("the result " + name + " of a layer is missing");
  return found->second;
}

LayerGraph::Named LayerGraph::add_value(int rows, int columns, int channels) {
  const int padded =
      (channels + Convolution::kChannels - 1) / Convolution::kChannels * Convolution::kChannels;
  values_.push_back({rows, columns, padded, 0, {}});
  return {values_.size() - 1, channels};
}

void LayerGraph::add_convolution(const onnx::Node& node, const Tensors& tensors) {
  const Named input = find(node.input(0));
  const auto weights = tensors.find(node.input_size() > 1 ? node.input(1) : "");
  const auto biases = tensors.find(node.input_size() > 2 ? node.input(2) : "");
  if (weights == tensors.end() || (node.input_size() > 2 && biases == tensors.end())) {
    refuse(node, "has no weights");
  }
  const auto& dims = weights->second->dims();
  if (dims.size() != 4 || dims[0] < 1 || dims[0] > kMostChannels || dims[1] != input.channels ||
      dims[2] < 1 || dims[2] > kMostKernel || dims[3] != dims[2] || input.scale != 1) {
    refuse(node, "has weights of another shape than its input needs");
  }
  const auto* group = find_attribute(node, "group");
  if (group != nullptr && group->i() != 1) refuse(node, "has groups");
  Convolution::Shape shape;
  shape.inputs = input.channels;
  shape.outputs = static_cast<int>(dims[0]);
  shape.kernel = static_cast<int>(dims[2]);
  shape.stride = equal_entries(node, "strides", 1, 1, kMostStep);
  shape.padding = equal_entries(node, "pads", 0, 0, kMostStep);
  shape.dilation = equal_entries(node, "dilations", 1, 1, kMostStep);
  const int rows = shape.output_size(values_[input.value].rows);
  const int columns = shape.output_size(values_[input.value].columns);
  if (rows < 1 || columns < 1) refuse(node, "has an input that is smaller than its kernel");
  const size_t count = static_cast<size_t>(dims[0] * dims[1] * dims[2] * dims[3]);
  Activations& from = values_[input.value];
  from.border = std::max(from.border, shape.padding);
  Layer layer;
  layer.convolution = std::make_shared<Convolution>(
      shape, numbers_of(node, *weights->second, count),
      biases == tensors.end()
          ? std::vector<float>{}
          : numbers_of(node, *biases->second, static_cast<size_t>(shape.outputs)),
      from.channels);
  layer.first = input;
  const Named output = add_value(rows, columns, shape.outputs);
  layer.output = output.value;
  layers_.push_back(layer);
  names_[node.output(0)] = output;
}

void LayerGraph::add_sum(const onnx::Node& node) {
  if (node.input_size() != 2) refuse(node, "has not two inputs");
  Layer layer;
  layer.first = find(node.input(0));
  layer.second = find(node.input(1));
  if (layer.first.scale != 1) std::swap(layer.first, layer.second);
  const Activations& a = values_[layer.first.value];
  const Activations& b = values_[layer.second.value];
  if (layer.first.scale != 1 || layer.first.channels != layer.second.channels ||
      a.rows != layer.second.scale * b.rows || a.columns != layer.second.scale * b.columns ||
      a.channels != b.channels) {
    refuse(node, "has inputs of different sizes");
  }
  const Named output = add_value(a.rows, a.columns, layer.first.channels);
  layer.output = output.value;
  layers_.push_back(layer);
  names_[node.output(0)] = output;
}

void LayerGraph::run() {
  for (const Layer& layer : layers_) {
    if (layer.convolution) {
      layer.convolution->run(values_[layer.first.value], values_[layer.output], layer.is_rectified);
    } else {
      run_sum(layer);
    }
  }
}

void LayerGraph::run_sum(const Layer& layer) {
  const Activations& first = values_[layer.first.value];
  const Activations& second = values_[layer.second.value];
  Activations& output = values_[layer.output];
  const int channels = output.channels;
  const float least = layer.is_rectified ? 0 : -std::numeric_limits<float>::infinity();
  for (int row = 0; row < output.rows; ++row) {
    for (int column = 0; column < output.columns; ++column) {
      const float* a = first.at(row, column);
      const float* b = second.at(row / layer.second.scale, column / layer.second.scale);
      float* sum = output.at(row, column);
      for (int i = 0; i < channels; ++i) sum[i] = std::max(a[i] + b[i], least);
    }
  }
}

int LayerGraph::num_outputs() const {
  int number = 0;
  for (const Named& output : outputs_) number += output.channels;
  return number;
}

void LayerGraph::copy_output(float* target) const {
  for (const Named& output : outputs_) {
    const Activations& value = values_[output.value];
    for (int channel = 0; channel < output.channels; ++channel) {
      for (int row = 0; row < value.rows; ++row) {
        const float* number = value.at(row, 0) + channel;
        for (int column = 0; column < value.columns; ++column, number += value.channels) {
          *target++ = *number;
        }
      }
    }
  }
}

}  // namespace nao::vision
