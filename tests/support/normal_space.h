// In src/check: `phalanx check` uses it, too.
#pragma once
#include "check/normal_space.h"

namespace phalanx::test {
using namespace check;
}
