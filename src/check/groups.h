// The groups of the catalogue: one file each.
#pragma once
#include "check.h"

namespace phalanx::check {

Group scale_group();
Group geometry_group();
Group materials_group();
Group lights_group();
Group media_group();
Group sampling_group();
Group camera_group();

}  // namespace phalanx::check
