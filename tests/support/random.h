// In src/check: `phalanx check` uses it, too.
#pragma once
#include "check/random.h"

namespace phalanx::test {
using namespace check;
}
