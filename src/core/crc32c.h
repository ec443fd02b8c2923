// CRC32C (Castagnoli): finds what was damaged on the way.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace phalanx {

/// The checksum of RFC 3720 over `bytes`. To go on over more bytes pass what came out before.
std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0);

/// 64 bits from two such sums over different readings of the bytes: names a scene or a set of options.
/// It finds changes, not forgeries.
class Fingerprint {
 public:
  void add(std::span<const std::byte> bytes);
  std::uint64_t value() const;

 private:
  std::uint32_t a_ = 0, b_ = 0x9e3779b9u;
  std::uint64_t size_ = 0;
};

}  // namespace phalanx
