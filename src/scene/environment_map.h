// Radiance from all directions, as a picture in latitude and longitude (kernels/physics/environment.h).
#pragma once
#include <vector>

#include "description.h"

namespace phalanx {

struct EnvironmentMap {
  int width = 0, height = 0;
  std::vector<float> texels;  // [height * width * 3] row 0 around the frame's +y, linear RGB, >= 0
  double turns = 0;  // the frame: the world's, turned about +y, counter-clockwise seen from above
};

}  // namespace phalanx
