// Which instruction sets this program has kernels for, and which of them run here.
#pragma once
#include <string>
#include <vector>

#include "kernels.h"

namespace phalanx {

/// "sse4", "avx2", "avx512skx", narrowest first.
std::vector<std::string> known_isas();
bool isa_supported(const std::string &isa);
/// The default: see docs/decisions/0005. Throws InputError on a processor without SSE4.2.
std::string best_isa();
/// `wanted`, or best_isa() where it is empty. Throws InputError for names that are not known and for
/// instruction sets that this processor lacks.
std::string resolve_isa(const std::string &wanted);
/// Kernels of a supported instruction set.
const Kernels &kernels_for(const std::string &isa);

}  // namespace phalanx
