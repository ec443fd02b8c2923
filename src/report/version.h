// The version of this program, as the build defines it.
#pragma once

namespace phalanx {

const char *version();

}  // namespace phalanx
