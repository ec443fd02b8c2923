// Mesh files that nobody here wrote, where they are at hand: the good ones render, the broken ones are
// refused with a message. They lie beside the repository, never in it.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "program.h"

using namespace phalanx;

namespace {

const std::filesystem::path kMeshes = PHALANX_SOURCE_DIR "/../shared/scenes/meshes";

bool absent() {
  if (std::filesystem::exists(kMeshes)) return false;
  MESSAGE("skipped: no shared meshes beside the repository");
  return true;
}

Outcome render_mesh(const std::string &name) {
  const TempDir dir;
  std::ofstream(dir / "scene.json") << R"({"version": 1,
    "camera": {"position": [0.3, 0.8, 4], "look_at": [0, 0.3, 0], "fov": 50},
    "film": {"width": 48, "height": 48}, "sampler": {"spp": 4},
    "materials": [{"name": "m", "type": "diffuse", "reflectance": 0.6}],
    "lights": [{"type": "environment", "radiance": 1}],
    "shapes": [{"type": "mesh", "material": "m", "file": ")" +
                                        std::filesystem::absolute(kMeshes / name).string() + R"("}]})";
  Outcome o = phalanx_in(dir, "render scene.json -o picture.png --strict --quiet");
  CHECK(std::filesystem::exists(dir / "picture.png") == (o.exit_code == 0));
  return o;
}

}  // namespace

TEST_CASE("real meshes: bunny, suzanne and a chair render") {
  if (absent()) return;
  for (const char *name : {"bunny.ply", "suzanne.ply", "chair_model.obj"}) {
    const Outcome o = render_mesh(name);
    CAPTURE(name);
    CAPTURE(o.err);
    CHECK(o.exit_code == 0);
  }
}

TEST_CASE("real meshes: every OBJ and PLY renders or is refused with a message that names it") {
  if (absent()) return;
  int rendered = 0, refused = 0;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(kMeshes)) {
    std::string extension = entry.path().extension().string();
    for (char &c : extension) c = static_cast<char>(std::tolower(c));
    if (extension != ".obj" && extension != ".ply") continue;
    const std::string name = std::filesystem::relative(entry.path(), kMeshes).string();
    const Outcome o = render_mesh(name);
    CAPTURE(name);
    CAPTURE(o.err);
    CHECK((o.exit_code == 0 || o.exit_code == 2));
    if (o.exit_code == 2) CHECK(o.err.find(entry.path().filename().string()) != std::string::npos);
    (o.exit_code == 0 ? rendered : refused) += 1;
  }
  CHECK(rendered >= 40);
  CHECK(refused >= 10);
}
