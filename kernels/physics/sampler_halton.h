// The Halton sequence, digits scrambled: coordinate d is the radical inverse of the sample's index in the
// d-th prime.
//
// True dimensions instead of padded pairs: pairs of the same two bases would go through their strata in
// step, and there is no shuffle of the index that keeps both bases. Primes are larger for later dimensions,
// and while there are fewer samples than the prime, that coordinate is hardly better than random.
// Scrambling is Owen's: each node of the tree of digits has a permutation of its own. It need only send
// any two digits anywhere, which d -> shift + factor * d does; but by themselves such maps let two primes
// run through their strata in step where the factors happen to agree, so a round of hashing comes first.
#pragma once
#include "../scene_view.h"
#include "permutation.h"

PHALANX_BEGIN

#define PHALANX_NUM_PRIMES 256
static const UNI int32 kPrimes[PHALANX_NUM_PRIMES] = {
    2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89, 97,
    101, 103, 107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193,
    197, 199, 211, 223, 227, 229, 233, 239, 241, 251, 257, 263, 269, 271, 277, 281, 283, 293, 307,
    311, 313, 317, 331, 337, 347, 349, 353, 359, 367, 373, 379, 383, 389, 397, 401, 409, 419, 421,
    431, 433, 439, 443, 449, 457, 461, 463, 467, 479, 487, 491, 499, 503, 509, 521, 523, 541, 547,
    557, 563, 569, 571, 577, 587, 593, 599, 601, 607, 613, 617, 619, 631, 641, 643, 647, 653, 659,
    661, 673, 677, 683, 691, 701, 709, 719, 727, 733, 739, 743, 751, 757, 761, 769, 773, 787, 797,
    809, 811, 821, 823, 827, 829, 839, 853, 857, 859, 863, 877, 881, 883, 887, 907, 911, 919, 929,
    937, 941, 947, 953, 967, 971, 977, 983, 991, 997, 1009, 1013, 1019, 1021, 1031, 1033, 1039,
    1049, 1051, 1061, 1063, 1069, 1087, 1091, 1093, 1097, 1103, 1109, 1117, 1123, 1129, 1151, 1153,
    1163, 1171, 1181, 1187, 1193, 1201, 1213, 1217, 1223, 1229, 1231, 1237, 1249, 1259, 1277, 1279,
    1283, 1289, 1291, 1297, 1301, 1303, 1307, 1319, 1321, 1327, 1361, 1367, 1373, 1381, 1399, 1409,
    1423, 1427, 1429, 1433, 1439, 1447, 1451, 1453, 1459, 1471, 1481, 1483, 1487, 1489, 1493, 1499,
    1511, 1523, 1531, 1543, 1549, 1553, 1559, 1567, 1571, 1579, 1583, 1597, 1601, 1607, 1609, 1613,
    1619
};

/// Scrambled radical inverse of `index` in base `prime`, in [0,1). Digits beyond those that tell the first
/// `n` indices apart are uniform.
PHYS float scrambled_radical_inverse(int32 index, int32 prime, uint32 seed, int32 n) {
  float value = 0.0f;
  float size = 1.0f;
  int32 rest = index;
  uint32 node = seed;
  while (size < to_float(n) || rest > 0) {
    node = hash32(node);
    const int32 next = quotient(rest, prime);
    const int32 mixed = permuted<1>(rest - next * prime, prime, node);
    const int32 factor = 1 + (int32)(((node & 0xffffu) * (uint32)(prime - 1)) >> 16);
    const int32 moved = to_int(unit_float(node) * to_float(prime)) + factor * mixed;
    const int32 digit = moved - quotient(moved, prime) * prime;
    value = value * to_float(prime) + to_float(digit);
    size = size * to_float(prime);
    rest = next;
    node = node + 0x9e3779b9u * (uint32)(digit + 1);
  }
  return below_one((value + unit_float(hash32(node))) / size);
}

/// Coordinates 2 * dimension and 2 * dimension + 1, 2 * dimension + 1 < PHALANX_NUM_PRIMES.
PHYS Vec2 halton_pair(const UNI FrameView &frame, uint32 h, int32 index, int32 dimension) {
  const float x = scrambled_radical_inverse(index, kPrimes[2 * dimension], h, frame.spp);
  const float y = scrambled_radical_inverse(index, kPrimes[2 * dimension + 1],
                                            hash32(h + 0x68bc21ebu), frame.spp);
  return vec2(x, y);
}

PHALANX_END
