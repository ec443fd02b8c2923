// What in a scene is hard on floating-point numbers, or on sampling, and what is done about it.
#pragma once
#include <string>
#include <vector>

#include "description.h"
#include "scene.h"

namespace phalanx {

struct Stiffness {
  std::string what;    // "43 triangles are slivers: less than 1e-5 as high as they are long"
  std::string remedy;  // what the program does about it, or what is left to the author
};

/// Far from the origin, mixed scales, slivers, nearly smooth surfaces, tiny and very bright lights, albedo of 1, extreme
/// indices of refraction. Empty for most scenes. Takes time in proportion to the number of triangles.
std::vector<Stiffness> find_stiffness(const SceneDescription &description, const Scene &scene);

}  // namespace phalanx
