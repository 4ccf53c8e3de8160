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

inline Vec load(const Packed3& v) { return {v.x, v.y, v.z}; }
inline void store(const Vec& v, Packed3& to) {
  to.x = v.x;
  to.y = v.y;
  to.z = v.z;
}
inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator-(const Vec& a) { return {-a.x, -a.y, -a.z}; }
inline Vec operator*(const Vec& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
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

#include "sim/tree_kernels.inl"

}  // namespace
}  // namespace generic

const TreeKernels& generic_tree_kernels() { return generic::kKernels; }

const TreeKernels& tree_kernels() {
  static const TreeKernels& kernels =
      avx2_tree_kernels() != nullptr ? *avx2_tree_kernels() : generic_tree_kernels();
  return kernels;
}

}  // namespace nao::sim
