#include "daemons/vision/convolution.h"

#include <algorithm>
#include <cstring>
#include <limits>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#include <sys/platform/x86.h>
#endif

namespace nao::vision {
namespace {

/** One row of the output. */
struct RowTask {
  /** First number under the kernel of the row's first place; distance to that of the next one. */
  const float* input;
  std::ptrdiff_t input_step;
  float* output;
  std::ptrdiff_t output_step;
  int columns;
  /** Pieces of the input under the kernel that lie side by side: where they begin, their length. */
  const std::ptrdiff_t* pieces;
  int num_pieces;
  int piece_length;
  const float* weights;
  const float* biases;
  /** Smaller outputs are raised to this. */
  float least;
};

namespace generic {
constexpr int kLanes = 4;
#include "daemons/vision/convolution.inl"
}  // namespace generic

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
constexpr int kLanes = 8;
#include "daemons/vision/convolution.inl"
}  // namespace avx2
#pragma GCC pop_options
const bool kHasAvx2 = CPU_FEATURE_ACTIVE(AVX2) && CPU_FEATURE_ACTIVE(FMA);
#else
namespace avx2 = generic;
constexpr bool kHasAvx2 = false;
#endif

int rounded_up(int number) {
  return (number + Convolution::kChannels - 1) / Convolution::kChannels * Convolution::kChannels;
}

}  // namespace

Convolution::Convolution(const Shape& shape, const std::vector<float>& weights,
                         const std::vector<float>& biases, int input_channels)
    : shape_(shape), input_channels_(input_channels) {
  const int lanes = kHasAvx2 ? avx2::kLanes : generic::kLanes;
  const int outputs = rounded_up(shape.outputs);
  const int num_vectors = outputs / lanes;
  block_ = lanes * (num_vectors % 3 == 0 ? 3 : num_vectors % 2 == 0 ? 2 : 1);
  const int area = shape.kernel * shape.kernel;
  weights_.reserve(static_cast<size_t>(outputs) * area * input_channels);
  for (int first = 0; first < outputs; first += block_) {
    for (int place = 0; place < area; ++place) {
      for (int input = 0; input < input_channels; ++input) {
        for (int output = first; output < first + block_; ++output) {
          const bool is_unused = input >= shape.inputs || output >= shape.outputs;
          const int index = (output * shape.inputs + input) * area + place;
          weights_.push_back(is_unused ? 0 : weights[static_cast<size_t>(index)]);
        }
      }
    }
  }
  biases_ = biases;
  biases_.resize(static_cast<size_t>(outputs), 0.0f);
}

void Convolution::run(const Activations& input, Activations& output, bool is_rectified) const {
  RowTask task{};
  task.input_step = static_cast<std::ptrdiff_t>(shape_.stride) * input.channels;
  task.output_step = output.channels;
  task.columns = output.columns;
  task.least = is_rectified ? 0 : -std::numeric_limits<float>::infinity();
  // Without dilation a row of the kernel is one piece.
  const int pieces_per_row = shape_.dilation == 1 ? 1 : shape_.kernel;
  task.piece_length = input.channels * (shape_.dilation == 1 ? shape_.kernel : 1);
  std::vector<std::ptrdiff_t> pieces;
  for (int row = 0; row < shape_.kernel; ++row) {
    for (int column = 0; column < pieces_per_row; ++column) {
      pieces.push_back(shape_.dilation * (row * static_cast<std::ptrdiff_t>(input.row_step()) +
                                          column * static_cast<std::ptrdiff_t>(input.channels)));
    }
  }
  task.pieces = pieces.data();
  task.num_pieces = static_cast<int>(pieces.size());
  const size_t block_weights =
      static_cast<size_t>(block_) * shape_.kernel * shape_.kernel * input_channels_;
  for (int row = 0; row < output.rows; ++row) {
    task.input = input.at(row * shape_.stride - shape_.padding, -shape_.padding);
    task.weights = weights_.data();
    for (int first = 0; first < output.channels; first += block_) {
      task.biases = biases_.data() + first;
      task.output = output.at(row, 0) + first;
      (kHasAvx2 ? avx2::convolve_row : generic::convolve_row)(task, block_);
      task.weights += block_weights;
    }
  }
}

}  // namespace nao::vision
