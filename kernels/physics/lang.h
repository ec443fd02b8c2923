// The shared dialect: one text that compiles as C++ and as ISPC.
//
// Every header in kernels/physics/ is compiled twice, by the C++ compiler (one path at a time) and by
// ISPC (one path per lane). This is the only file that asks which of the two is running. The rules:
//   PHYS       marks a physics function; values in, values out.
//   PHYS_CALL  the same, never inlined: for what would make its callers too large to compile.
//   UNI        marks what is the same for all lanes: scene data, settings. Nothing in C++.
//   literals   always carry an f; array indices are int32; negate vectors with neg(v).
// min, max and abs are defined here because the two languages disagree about NaN and signed zero.
#pragma once

#ifdef ISPC

#define PHYS static inline
#define PHYS_CALL static noinline
#define UNI uniform
#define PHALANX_BEGIN
#define PHALANX_END

PHYS float float_from_bits(int32 b) { return floatbits((unsigned int32)b); }
PHYS int32 bits_from_float(float f) { return intbits(f); }
PHYS float to_float(int32 i) { return (float)i; }
PHYS int32 to_int(float f) { return (int32)f; }
PHYS float square_root(float x) { return sqrt(x); }
PHYS float round_down(float x) { return floor(x); }

/// array[index]. Lanes mostly want the same element (of materials, geometries, lights): then it is
/// loaded once instead of gathered field by field.
template <typename T>
PHYS T fetch(const uniform T *uniform array, int32 index) {
  uniform int32 common;
  if (reduce_equal(index, &common)) return array[common];
  return array[index];
}

#else

#include <bit>
#include <cmath>
#include <cstdint>

#ifdef __FAST_MATH__
#error "Phalanx relies on IEEE arithmetic: -ffast-math would delete its NaN checks (STABILITY: Q9)."
#endif

#define PHYS [[maybe_unused]] static inline
#define PHYS_CALL [[maybe_unused, gnu::noinline]] static
#define UNI
#define PHALANX_BEGIN namespace phalanx {
#define PHALANX_END }

PHALANX_BEGIN
using int32 = std::int32_t;
using uint32 = std::uint32_t;

PHYS float float_from_bits(int32 b) { return std::bit_cast<float>(b); }
PHYS int32 bits_from_float(float f) { return std::bit_cast<int32>(f); }
PHYS float to_float(int32 i) { return static_cast<float>(i); }
PHYS int32 to_int(float f) { return static_cast<int32>(f); }
PHYS float square_root(float x) { return __builtin_sqrtf(x); }
PHYS float round_down(float x) { return __builtin_floorf(x); }
template <typename T>
PHYS T fetch(const T *array, int32 index) {
  return array[index];
}
PHALANX_END

#endif

PHALANX_BEGIN

// The segment of every ray. Infinities never enter a ray. A ray that starts exactly on a plane through
// the origin of an axis (a floor at y = 0: no rounding, no offset) meets it at t = 0, which must not
// count; the smallest distance is far below any scene's, and its product with a triangle's area is
// still no denormal.
#define PHALANX_FAR 3.0e38f
#define PHALANX_NEAR 1.0e-20f

PHYS float min_of(float a, float b) { return a < b ? a : b; }
PHYS float max_of(float a, float b) { return a > b ? a : b; }
PHYS float abs_of(float a) { return float_from_bits(bits_from_float(a) & 0x7fffffff); }
PHYS float clamp_to(float x, float lo, float hi) { return min_of(max_of(x, lo), hi); }
PHYS float copy_sign(float magnitude, float sign) {
  return float_from_bits((bits_from_float(magnitude) & 0x7fffffff) |
                         (bits_from_float(sign) & (int32)0x80000000u));
}
/// True for every number that is neither NaN nor infinite. Reads the exponent bits, so that no
/// optimisation can decide that it is always true.
PHYS bool is_finite(float x) { return (bits_from_float(x) & 0x7f800000) != 0x7f800000; }
/// sqrt(max(x, 0)): arguments that are negative by a rounding error give 0, NaN gives 0.
PHYS float safe_sqrt(float x) { return square_root(max_of(x, 0.0f)); }

PHALANX_END
