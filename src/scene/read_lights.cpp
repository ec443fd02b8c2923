// "lights": what shines without being a surface. Surfaces shine by their material's emission.
#include "read_scene.h"

namespace phalanx {

void read_lights(const std::vector<Node> &nodes, Source &source, SceneDescription &scene) {
  for (const Node &node : nodes) {
    ObjectReader object(node, source);
    int type = 0;
    if (!object.choice("type", {{"environment", 0}}, type, kRequired)) {
      object.give_up("a light");
      continue;
    }
    object.colour("radiance", kRadiance, scene.environment, kRequired);
    object.finish("an environment light");
    if (scene.has_environment)
      source.error(node, "a second environment light; a scene has one at most");
    scene.has_environment = true;
  }
}

}  // namespace phalanx
