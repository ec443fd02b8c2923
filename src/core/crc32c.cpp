// SSE4.2 has an instruction for this very polynomial, and the program needs SSE4.2 anyway.
#include "crc32c.h"

#include <nmmintrin.h>

#include <cstring>

namespace phalanx {

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before) {
  std::uint64_t crc = before ^ 0xffffffffu;
  const std::byte *p = bytes.data(), *const end = p + bytes.size();
  for (; end - p >= 8; p += 8) {
    std::uint64_t word;
    std::memcpy(&word, p, 8);
    crc = _mm_crc32_u64(crc, word);
  }
  for (; p < end; ++p)
    crc = _mm_crc32_u8(static_cast<std::uint32_t>(crc), std::to_integer<std::uint8_t>(*p));
  return static_cast<std::uint32_t>(crc) ^ 0xffffffffu;
}

void Fingerprint::add(std::span<const std::byte> bytes) {
  // CRCs are linear: two of the same polynomial differ by a constant. The second reads words that
  // were multiplied, which is not linear over GF(2).
  a_ = crc32c(bytes, a_);
  const std::byte *p = bytes.data();
  std::size_t left = bytes.size();
  while (left > 0) {
    std::uint64_t word = 0;
    const std::size_t n = left < 8 ? left : 8;
    std::memcpy(&word, p, n);
    word = (word + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    b_ = static_cast<std::uint32_t>(_mm_crc32_u64(b_, word ^ (word >> 29)));
    p += n;
    left -= n;
  }
  size_ += bytes.size();
}

std::uint64_t Fingerprint::value() const {
  return (std::uint64_t{b_} << 32 | a_) ^ (size_ * 0x9e3779b97f4a7c15u);
}

}  // namespace phalanx
