#include "isa.h"

#include <fmt/format.h>

#include "../core/error.h"

namespace phalanx {
namespace {

/// What the compilers take for granted with AVX2 (Haswell and later).
bool has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
         __builtin_cpu_supports("f16c") && __builtin_cpu_supports("lzcnt");
}

}  // namespace

std::vector<std::string> known_isas() {
  return {
#ifdef PHALANX_HAS_sse4
      "sse4",
#endif
#ifdef PHALANX_HAS_avx2
      "avx2",
#endif
#ifdef PHALANX_HAS_avx512skx
      "avx512skx",
#endif
  };
}

bool isa_supported(const std::string &isa) {
  if (isa == "sse4") return __builtin_cpu_supports("sse4.2");
  if (isa == "avx2") return has_avx2();
  if (isa == "avx512skx") {
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512cd");
  }
  return false;
}

std::string best_isa() {
  std::string best;
  for (const std::string &isa : known_isas())
    if (isa_supported(isa)) best = isa;
  if (best.empty())
    throw InputError("this processor lacks SSE4.2; Phalanx needs an x86-64 processor with it");
  return best;
}

std::string resolve_isa(const std::string &wanted) {
  if (wanted.empty()) return best_isa();
  std::string names;
  for (const std::string &isa : known_isas()) {
    if (isa == wanted) {
      if (isa_supported(isa)) return isa;
      throw InputError(fmt::format("--isa {}: this processor does not have it; it can run {}",
                                   wanted, best_isa()));
    }
    names += names.empty() ? isa : ", " + isa;
  }
  throw InputError(fmt::format("--isa {}: not known; known are {}", wanted, names));
}

const Kernels &kernels_for(const std::string &isa) {
#ifdef PHALANX_HAS_avx512skx
  if (isa == "avx512skx") return kernels_avx512skx();
#endif
#ifdef PHALANX_HAS_avx2
  if (isa == "avx2") return kernels_avx2();
#endif
#ifdef PHALANX_HAS_sse4
  if (isa == "sse4") return kernels_sse4();
#endif
  throw InputError(fmt::format("this program was built without kernels for {}", isa));
}

}  // namespace phalanx
