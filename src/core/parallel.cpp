#include "parallel.h"

#include <immintrin.h>
#include <omp.h>

#include <atomic>
#include <exception>

namespace phalanx {

int max_threads() { return omp_get_max_threads(); }

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) {
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero);
}

FlushDenormals::~FlushDenormals() { _mm_setcsr(saved_); }

void parallel_for(std::int64_t count, int threads,
                  const std::function<void(std::int64_t, int)> &work) {
  std::exception_ptr failure;
  std::atomic<bool> failed = false;
#pragma omp parallel num_threads(threads)
  {
    const FlushDenormals flush;
#pragma omp for schedule(dynamic, 1)
    for (std::int64_t i = 0; i < count; ++i) {
      if (failed.load(std::memory_order_relaxed)) continue;
      try {
        work(i, omp_get_thread_num());
      } catch (...) {
        if (!failed.exchange(true)) failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace phalanx
