// A scene that was read and built.
#pragma once
#include "description.h"
#include "scene.h"

namespace phalanx {

struct LoadedScene {
  SceneDescription description;  // on ranks other than 0 only camera, film, sampler and integrator
  Scene scene;
};

}  // namespace phalanx
