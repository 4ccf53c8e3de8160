// Included by convolution.cpp for each kind of processor, with its kLanes: numbers of a vector.

typedef float Vector __attribute__((vector_size(4 * kLanes)));

/** The sums of P places and V vectors stay in registers; each weight is read once for P places. */
template <int V, int P>
inline void convolve_places(const RowTask& task, int column) {
  const float* input = task.input + column * task.input_step;
  const float* weights = task.weights;
  // In single loops, which the compiler unrolls early enough to keep the arrays in registers.
  Vector sums[P * V];
#pragma GCC unroll 12
  for (int j = 0; j < P * V; ++j) {
    std::memcpy(&sums[j], task.biases + j % V * kLanes, sizeof(Vector));
  }
  for (int piece = 0; piece < task.num_pieces; ++piece) {
    const float* numbers = input + task.pieces[piece];
    for (int i = 0; i < task.piece_length; ++i) {
      Vector weight[V];
#pragma GCC unroll 3
      for (int v = 0; v < V; ++v) std::memcpy(&weight[v], weights + v * kLanes, sizeof(Vector));
      weights += V * kLanes;
#pragma GCC unroll 12
      for (int j = 0; j < P * V; ++j) {
        sums[j] += numbers[j / V * task.input_step + i] * weight[j % V];
      }
    }
  }
  float* output = task.output + column * task.output_step;
  const Vector least = Vector{} + task.least;
#pragma GCC unroll 12
  for (int j = 0; j < P * V; ++j) {
    const Vector sum = sums[j] > least ? sums[j] : least;
    std::memcpy(output + j / V * task.output_step + j % V * kLanes, &sum, sizeof sum);
  }
}

template <int V, int P>
inline void convolve_places(const RowTask& task) {
  if (task.columns < P) {
    for (int column = 0; column < task.columns; ++column) convolve_places<V, 1>(task, column);
    return;
  }
  // The last block begins earlier instead of being shorter; some places are then computed twice.
  for (int column = 0; column < task.columns; column += P) {
    convolve_places<V, P>(task, std::min(column, task.columns - P));
  }
}

// Eight sums at least keep two units busy whose results take four cycles; 16 registers must hold
// them, the weights and a number.
void convolve_row(const RowTask& task, int block) {
  if (block == 3 * kLanes) return convolve_places<3, 4>(task);
  if (block == 2 * kLanes) return convolve_places<2, 4>(task);
  convolve_places<1, 8>(task);
}
