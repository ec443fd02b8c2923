#include "scenes.h"

#include <doctest/doctest.h>

#include <cstring>

#include "wavefront/isa.h"

namespace phalanx::test {
namespace {

BuiltScene build(SceneDescription description, Diagnostics &diagnostics, const std::string &isa) {
  BuiltScene b;
  b.description = std::move(description);
  b.scene = build_scene(b.description, diagnostics);
  for (const Problem &p : diagnostics.errors()) FAIL(p.text());
  b.isa = isa;
  b.accel = std::make_unique<Accel>(b.scene, isa, 1);
  return b;
}

}  // namespace

BuiltScene build_text(const std::string &json, const std::string &isa) {
  Diagnostics diagnostics;
  return build(parse_scene_text(json, "test.json", PHALANX_SOURCE_DIR, diagnostics), diagnostics,
               isa);
}

BuiltScene build_file(const std::string &path, const std::string &isa) {
  Diagnostics diagnostics;
  return build(load_scene_file(std::string(PHALANX_SOURCE_DIR) + "/" + path, diagnostics),
               diagnostics, isa);
}

RenderResult render_scene(const BuiltScene &b, RenderOptions options) {
  options.isa = b.isa;
  const Plan plan = make_plan(b.description, b.scene, options);
  return render(b.scene, *b.accel, plan, options);
}

std::int64_t pixels_that_differ(const Film &a, const Film &b) {
  std::int64_t n = a.num_pixels() == b.num_pixels() ? 0 : -1;
  for (std::int64_t i = 0; n >= 0 && i < a.num_pixels(); ++i) {
    const Vec3 colours[] = {a.mean(i), b.mean(i), a.variance_of_mean(i), b.variance_of_mean(i)};
    bool same = std::memcmp(&colours[0], &colours[1], sizeof(Vec3)) == 0 &&
                std::memcmp(&colours[2], &colours[3], sizeof(Vec3)) == 0;
    if (a.has_aovs() && b.has_aovs()) {
      const Vec3 planes[] = {a.albedo(i), b.albedo(i), a.normal(i), b.normal(i)};
      same = same && std::memcmp(&planes[0], &planes[1], sizeof(Vec3)) == 0 &&
             std::memcmp(&planes[2], &planes[3], sizeof(Vec3)) == 0 && a.depth(i) == b.depth(i);
    }
    n += same ? 0 : 1;
  }
  return n;
}

std::vector<std::string> isas_here() {
  std::vector<std::string> isas;
  for (const std::string &isa : known_isas())
    if (isa_supported(isa)) isas.push_back(isa);
  return isas;
}

}  // namespace phalanx::test
