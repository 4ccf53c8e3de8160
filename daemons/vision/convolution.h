#pragma once

#include <cstddef>
#include <vector>

namespace nao::vision {

/** Numbers of the places of a grid: all channels of a place side by side, the places row by row,
 * with a border of zeros around them. */
struct Activations {
  int rows = 0;
  int columns = 0;
  /** Numbers of a place. */
  int channels = 0;
  /** Rows and columns of zeros on each side. */
  int border = 0;
  std::vector<float> numbers;

  /** Takes the memory, once the members above are set. */
  void allocate() { numbers.assign(static_cast<size_t>(rows + 2 * border) * row_step(), 0.0f); }
  /** Distance between two rows. */
  size_t row_step() const { return static_cast<size_t>(columns + 2 * border) * channels; }
  /** @param row, column  From -border. */
  float* at(int row, int column) {
    return numbers.data() + static_cast<size_t>(row + border) * row_step() +
           static_cast<size_t>(column + border) * channels;
  }
  const float* at(int row, int column) const {
    return const_cast<Activations*>(this)->at(row, column);
  }
};

/** A two-dimensional convolution with square kernels, as ONNX's "Conv" with one group, computed
 * directly from the places of its input, with the processor's widest usual vectors.
 *
 * Equal inputs give equal bits on one kind of processor; processors with fused multiplication and
 * addition round less. */
class Convolution {
 public:
  struct Shape {
    int inputs = 0;
    int outputs = 0;
    int kernel = 1;
    int stride = 1;
    /** Rows and columns of zeros around the input. */
    int padding = 0;
    int dilation = 1;

    /** Number of rows or columns of the output; 0 if the kernel does not fit. */
    int output_size(int input_size) const {
      const int room = input_size + 2 * padding - dilation * (kernel - 1) - 1;
      return room < 0 ? 0 : room / stride + 1;
    }
  };
  /** Activations of an output have a multiple of this many channels; those beyond it are 0. */
  static constexpr int kChannels = 8;

  /** @param weights  outputs x inputs x kernel x kernel. @param biases  One for each output; empty:
   * zeros. @param input_channels  Channels of the input's Activations: at least the inputs. */
  Convolution(const Shape& shape, const std::vector<float>& weights,
              const std::vector<float>& biases, int input_channels);

  /** @param input  With a border of at least the padding. @param output  Of the size that the shape
   * gives. @param is_rectified  Negative outputs become 0. */
  void run(const Activations& input, Activations& output, bool is_rectified) const;

  const Shape& shape() const { return shape_; }

 private:
  Shape shape_;
  int input_channels_;
  /** Channels of a block, of which each has its weights in one piece: place by place of the
   * kernel, input by input, channel by channel of the block. */
  int block_;
  std::vector<float> weights_;
  std::vector<float> biases_;
};

}  // namespace nao::vision
