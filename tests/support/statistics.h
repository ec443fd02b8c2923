// In src/check: `phalanx check` uses it, too.
#pragma once
#include "check/statistics.h"

namespace phalanx::test {
using namespace check;
}
