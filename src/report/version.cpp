#include "version.h"

#ifndef PHALANX_VERSION
#error "the build defines PHALANX_VERSION: see CMakeLists.txt"
#endif

namespace phalanx {

const char *version() { return PHALANX_VERSION; }

}  // namespace phalanx
