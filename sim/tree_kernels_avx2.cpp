#include <cmath>

#include "sim/tree_kernels.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#include <immintrin.h>
#include <sys/platform/x86.h>

// Without FMA, whose bits differ. Nothing in it may be an inline function of another header: the
// linker could choose this copy for processors without AVX2.
#pragma GCC push_options
#pragma GCC target("avx2")

namespace nao::sim {
namespace avx2 {
namespace {

/** x, y, z, 0. */
struct Vec {
  __m256d v = __m256d{0, 0, 0, 0};
};

inline Vec load(const Packed3& v) {
  return {_mm256_load_pd(&v.x)};
}
inline void store(const Vec& v, Packed3& to) {
  _mm256_store_pd(&to.x, v.v);
}
inline Vec operator+(const Vec& a, const Vec& b) {
  return {_mm256_add_pd(a.v, b.v)};
}
inline Vec operator-(const Vec& a, const Vec& b) {
  return {_mm256_sub_pd(a.v, b.v)};
}
inline Vec operator-(const Vec& a) {
  return {_mm256_xor_pd(a.v, _mm256_set_pd(0, -0.0, -0.0, -0.0))};
}
inline Vec operator*(const Vec& a, double s) {
  return {_mm256_mul_pd(a.v, _mm256_set1_pd(s))};
}
inline double dot(const Vec& a, const Vec& b) {
  const __m256d p = _mm256_mul_pd(a.v, b.v);
  const __m128d xy = _mm256_castpd256_pd128(p);
  const __m128d z = _mm256_extractf128_pd(p, 1);
  return _mm_cvtsd_f64(_mm_add_sd(_mm_add_sd(xy, _mm_unpackhi_pd(xy, xy)), z));
}
/** y, z, x, 0. */
inline __m256d rotate(__m256d v) {
  return _mm256_permute4x64_pd(v, 0b11001001);
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {rotate(_mm256_sub_pd(_mm256_mul_pd(a.v, rotate(b.v)), _mm256_mul_pd(rotate(a.v), b.v)))};
}
/** Copies the lower triangle of a matrix of these columns to the upper one. */
inline void mirror(const Vec& x, Vec& y, Vec& z) {
  // Rows 0 and 1 of columns 0 and 1: x.y to y.x.
  y.v = _mm256_blend_pd(y.v, _mm256_permute_pd(x.v, 0b0001), 0b0001);
  // x.z and y.z to the first two of z.
  const __m256d upper = _mm256_unpacklo_pd(x.v, y.v);
  z.v = _mm256_blend_pd(z.v, _mm256_permute2f128_pd(upper, upper, 0x11), 0b0011);
}
inline void add_diagonal(double value, Vec& x, Vec& y, Vec& z) {
  const __m256d zero = _mm256_setzero_pd();
  const __m256d all = _mm256_set1_pd(value);
  x.v = _mm256_add_pd(x.v, _mm256_blend_pd(zero, all, 0b0001));
  y.v = _mm256_add_pd(y.v, _mm256_blend_pd(zero, all, 0b0010));
  z.v = _mm256_add_pd(z.v, _mm256_blend_pd(zero, all, 0b0100));
}

/** Four entries of a row. */
struct Quad {
  __m256d v;
};
inline Quad load_quad(const double* from) {
  return {_mm256_loadu_pd(from)};
}
inline void store_quad(const Quad& quad, double* to) {
  _mm256_storeu_pd(to, quad.v);
}
inline void store_pair(const Quad& quad, double* to) {
  _mm_storeu_pd(to, _mm256_castpd256_pd128(quad.v));
}
inline Quad operator+(const Quad& a, const Quad& b) {
  return {_mm256_add_pd(a.v, b.v)};
}
inline Quad operator-(const Quad& a, const Quad& b) {
  return {_mm256_sub_pd(a.v, b.v)};
}
inline Quad operator*(const Quad& a, double s) {
  return {_mm256_mul_pd(a.v, _mm256_set1_pd(s))};
}
inline Quad operator*(const Quad& a, const Quad& b) {
  return {_mm256_mul_pd(a.v, b.v)};
}
inline double sum_of(const Quad& quad) {
  const __m128d pair = _mm_add_pd(_mm256_castpd256_pd128(quad.v), _mm256_extractf128_pd(quad.v, 1));
  return _mm_cvtsd_f64(_mm_add_sd(pair, _mm_unpackhi_pd(pair, pair)));
}

#include "sim/tree_kernels.inl"

}  // namespace
}  // namespace avx2

#pragma GCC pop_options

// By the C library, which can be told to do without: GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2.
const TreeKernels* avx2_tree_kernels() {
  return CPU_FEATURE_ACTIVE(AVX2) ? &avx2::kKernels : nullptr;
}

}  // namespace nao::sim
#else

namespace nao::sim {
const TreeKernels* avx2_tree_kernels() {
  return nullptr;
}
}  // namespace nao::sim
#endif
