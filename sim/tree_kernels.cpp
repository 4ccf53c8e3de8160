#include "sim/tree_kernels.h"

#include <cmath>

namespace nao::sim {
namespace generic {
namespace {

struct Vec {
  double x = 0;
  double y = 0;
  double z = 0;
};

inline Vec load(const Packed3& v) {
  return {v.x, v.y, v.z};
}
inline void store(const Vec& v, Packed3& to) {
  to.x = v.x;
  to.y = v.y;
  to.z = v.z;
}
inline Vec operator+(const Vec& a, const Vec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator-(const Vec& a) {
  return {-a.x, -a.y, -a.z};
}
inline Vec operator*(const Vec& a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline double dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/** Copies the lower triangle of a matrix of these columns to the upper one. */
inline void mirror(const Vec& x, Vec& y, Vec& z) {
  y.x = x.y;
  z.x = x.z;
  z.y = y.z;
}
inline void add_diagonal(double value, Vec& x, Vec& y, Vec& z) {
  x.x += value;
  y.y += value;
  z.z += value;
}

typedef double Pair __attribute__((vector_size(16)));
/** Four entries of a row. */
struct Quad {
  Pair low = {0, 0};
  Pair high = {0, 0};
};
inline Quad load_quad(const double* from) {
  Quad quad;
  __builtin_memcpy(&quad.low, from, sizeof(Pair));
  __builtin_memcpy(&quad.high, from + 2, sizeof(Pair));
  return quad;
}
inline void store_quad(const Quad& quad, double* to) {
  __builtin_memcpy(to, &quad.low, sizeof(Pair));
  __builtin_memcpy(to + 2, &quad.high, sizeof(Pair));
}
inline void store_pair(const Quad& quad, double* to) {
  __builtin_memcpy(to, &quad.low, sizeof(Pair));
}
inline Quad operator+(const Quad& a, const Quad& b) {
  return {a.low + b.low, a.high + b.high};
}
inline Quad operator-(const Quad& a, const Quad& b) {
  return {a.low - b.low, a.high - b.high};
}
inline Quad operator*(const Quad& a, double s) {
  return {a.low * s, a.high * s};
}
inline Quad operator*(const Quad& a, const Quad& b) {
  return {a.low * b.low, a.high * b.high};
}
inline double sum_of(const Quad& quad) {
  const Pair pair = quad.low + quad.high;
  return pair[0] + pair[1];
}

#include "sim/tree_kernels.inl"

}  // namespace
}  // namespace generic

const TreeKernels& generic_tree_kernels() {
  return generic::kKernels;
}

const TreeKernels& tree_kernels() {
  static const TreeKernels& kernels =
      avx2_tree_kernels() != nullptr ? *avx2_tree_kernels() : generic_tree_kernels();
  return kernels;
}

}  // namespace nao::sim
