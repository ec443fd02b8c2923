// Arrays aligned to cache lines, for SoA columns.
#pragma once
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

namespace phalanx {

inline constexpr std::size_t kCacheLine = 64;

constexpr std::size_t round_up(std::size_t n, std::size_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

/// One allocation that hands out aligned pieces in turn; freed as a whole. Memory starts zeroed.
class Arena {
 public:
  /// Throws std::bad_alloc.
  explicit Arena(std::size_t bytes)
      : bytes_(round_up(bytes, kCacheLine)),
        memory_(static_cast<std::byte *>(std::aligned_alloc(kCacheLine, bytes_))) {
    if (!memory_) throw std::bad_alloc();
    for (std::size_t i = 0; i < bytes_; ++i) memory_.get()[i] = std::byte{0};
  }

  /// `count` elements, starting on a cache line. The arena was made large enough by its owner.
  template <typename T>
  T *take(std::size_t count) {
    T *result = reinterpret_cast<T *>(memory_.get() + used_);
    used_ += round_up(count * sizeof(T), kCacheLine);
    if (used_ > bytes_) throw std::bad_alloc();
    return result;
  }

  std::size_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(std::byte *p) const { std::free(p); }
  };
  std::size_t bytes_;
  std::size_t used_ = 0;
  std::unique_ptr<std::byte, Free> memory_;
};

}  // namespace phalanx
