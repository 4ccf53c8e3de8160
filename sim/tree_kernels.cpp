#include "sim/tree_kernels.h"

#include <cmath>

namespace nao::sim {
namespace generic {
namespace {

typedef double Pair __attribute__((vector_size(16)));

/** x and y, z. */
struct Vec {
  Pair xy = {0, 0};
  double z = 0;
};

inline Vec load(const Packed3& v) {
  Vec result;
  __builtin_memcpy(&result.xy, &v.x, sizeof(Pair));
  result.z = v.z;
  return result;
}
inline void store(const Vec& v, Packed3& to) {
  __builtin_memcpy(&to.x, &v.xy, sizeof(Pair));
  to.z = v.z;
}
inline Vec operator+(const Vec& a, const Vec& b) {
  return {a.xy + b.xy, a.z + b.z};
}
inline Vec operator-(const Vec& a, const Vec& b) {
  return {a.xy - b.xy, a.z - b.z};
}
inline Vec operator-(const Vec& a) {
  return {-a.xy, -a.z};
}
inline Vec operator*(const Vec& a, double s) {
  return {a.xy * s, a.z * s};
}
inline double dot(const Vec& a, const Vec& b) {
  const Pair xy = a.xy * b.xy;
  return xy[0] + xy[1] + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
  const Pair a_yz = {a.xy[1], a.z};
  const Pair b_yz = {b.xy[1], b.z};
  const Pair a_zx = {a.z, a.xy[0]};
  const Pair b_zx = {b.z, b.xy[0]};
  return {a_yz * b_zx - a_zx * b_yz, a.xy[0] * b.xy[1] - a.xy[1] * b.xy[0]};
}
/** Copies the lower triangle of a matrix of these columns to the upper one. */
inline void mirror(const Vec& x, Vec& y, Vec& z) {
  y.xy[0] = x.xy[1];
  z.xy = Pair{x.z, y.z};
}
inline void add_diagonal(double value, Vec& x, Vec& y, Vec& z) {
  x.xy[0] += value;
  y.xy[1] += value;
  z.z += value;
}

/** Four entries of a row. */
struct Quad {
  Pair low;
  Pair high;
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
