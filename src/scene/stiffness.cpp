#include "stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "build_materials.h"
#include "transform.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr double kCoarseStep = 1e-4;       // of the median edge, between neighbouring floats
constexpr double kMixedScales = 1e6;       // largest shape over the smallest
constexpr double kSliver = 1e-5;           // height over the longest edge
constexpr double kLeastAlpha = 1e-3;
constexpr double kSharpAlpha = 1e-2;
constexpr double kTinyLight = 1e-3;        // of the scene's diagonal
constexpr double kBrightLight = 1e4;       // times the radiance of a lamp that filled the room as brightly
constexpr double kExtremeIndex = 4;

std::string count_of(std::int64_t count, const char *one, const char *many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// Names of the materials for which `is` holds, at most three.
template <typename Is>
std::string materials_that(const SceneDescription &scene, const Is &is) {
  std::string names;
  int found = 0;
  for (const MaterialDescription &m : scene.materials) {
    if (!is(m)) continue;
    if (++found <= 3) names += (names.empty() ? "'" : ", '") + m.name + "'";
  }
  return found > 3 ? fmt::format("{} and {} more", names, found - 3) : names;
}

double diagonal(const Scene &scene) {
  const Vec3 size = scene.bounds_hi - scene.bounds_lo;
  return size.x >= 0 ? static_cast<double>(length(size)) : 0;
}

double largest_coordinate(const Scene &scene) {
  return static_cast<double>(max_component(max3(abs3(scene.bounds_lo), abs3(scene.bounds_hi))));
}

struct TriangleFigures {
  std::vector<double> edges;  // longest edge of each triangle, of at most 10^5
  std::int64_t slivers = 0;
};

TriangleFigures look_at_triangles(const Scene &scene) {
  TriangleFigures figures;
  const size_t stride = scene.triangles.size() / 100000 + 1;
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    const Triangle &t = scene.triangles[i];
    Double3 p[3];
    for (size_t corner = 0; corner < 3; ++corner) {
      const std::int32_t v = corner == 0 ? t.v0 : corner == 1 ? t.v1 : t.v2;
      for (size_t axis = 0; axis < 3; ++axis) p[corner][axis] = double{scene.positions[static_cast<size_t>(v) * 3 + axis]};
    }
    const auto edge = [&](size_t a, size_t b) { return Double3{p[b][0] - p[a][0], p[b][1] - p[a][1], p[b][2] - p[a][2]}; };
    const Double3 ab = edge(0, 1), ac = edge(0, 2), bc = edge(1, 2);
    const double longest = std::max({length(ab), length(ac), length(bc)});
    figures.slivers += length(cross(ab, ac)) < kSliver * longest * longest;
    if (i % stride == 0) figures.edges.push_back(longest);
  }
  return figures;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Step between neighbouring floats at x.
double step_at(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - static_cast<double>(f);
}

class Finder {
 public:
  Finder(const SceneDescription &description, const Scene &scene) : description_(description), scene_(scene) {}

  std::vector<Stiffness> find() {
    find_distance();
    find_scales();
    find_roughness();
    find_lights();
    find_albedos();
    find_indices();
    return std::move(found_);
  }

 private:
  void add(std::string what, std::string remedy) { found_.push_back({std::move(what), std::move(remedy)}); }

  void find_distance() {
    const Double3 &o = description_.origin;
    if (length(o) > 0)
      add(fmt::format("the scene is {:.3g} m large and {:.3g} m away from the origin", diagonal(scene_), length(o)),
          fmt::format("it is computed around its middle ({:g}, {:g}, {:g}); vertices of mesh files keep the digits that "
                      "they were stored with",
                      o[0], o[1], o[2]));
    const TriangleFigures figures = look_at_triangles(scene_);
    if (!figures.edges.empty()) {
      const double step = step_at(largest_coordinate(scene_)), edge = median(figures.edges);
      if (step > kCoarseStep * edge)
        add(fmt::format("coordinates of {:.3g} m come in steps of {:.2g} m, but the median triangle is only {:.2g} m long",
                        largest_coordinate(scene_), step, edge),
            "rays start further off surfaces, in proportion; small parts lose their shape: move them nearer to the "
            "origin, or into a group with an instance");
    }
    if (figures.slivers > 0)
      add(count_of(figures.slivers, "triangle is a sliver", "triangles are slivers") +
              fmt::format(": less than {:g} times as high as long", kSliver),
          "ray queries are robust, so that none is missed; points are kept within their triangle");
  }

  void find_scales() {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Quad &q : scene_.quads) note_size(static_cast<double>(length(q.edge_u + q.edge_v)), least, most);
    for (const Sphere &s : scene_.spheres) note_size(2 * static_cast<double>(s.radius), least, most);
    for (const Disk &d : scene_.disks) note_size(2 * static_cast<double>(length(d.axis_u)), least, most);
    if (most > kMixedScales * least)
      add(fmt::format("shapes from {:.2g} to {:.2g} m", least, most),
          "rays start off each surface by its own rounding error, not by one distance for all");
  }
  static void note_size(double size, double &least, double &most) {
    least = std::min(least, size);
    most = std::max(most, size);
  }

  static double alpha_of(const MaterialDescription &m) {
    const double roughness = m.anisotropic ? std::min(m.roughness_x, m.roughness_y) : m.roughness;
    return roughness * roughness;
  }
  static bool has_microfacets(const MaterialDescription &m) {
    return m.kind == kConductor || m.kind == kGlossyConductor || m.kind == kRoughDielectric || m.kind == kDielectric || m.kind == kCoated;
  }
  void find_roughness() {
    const std::string smooth = materials_that(description_, [](const MaterialDescription &m) {
      return has_microfacets(m) && alpha_of(m) > 0 && alpha_of(m) < kLeastAlpha;
    });
    if (!smooth.empty())
      add("nearly smooth: " + smooth + " (alpha below 0.001)",
          "highlights are narrower than floats can describe: these are perfectly smooth, or have alpha 0.001 along the "
          "smoother axis");
    const std::string sharp = materials_that(description_, [](const MaterialDescription &m) {
      return has_microfacets(m) && alpha_of(m) >= kLeastAlpha && alpha_of(m) < kSharpAlpha;
    });
    if (!sharp.empty())
      add("sharp highlights: " + sharp + " (alpha below 0.01)",
          "light is found both by sampling lights and by scattering; after a diffuse bounce it still takes many samples");
  }

  void find_lights() {
    const double size = diagonal(scene_);
    std::int64_t tiny = 0, without_extent = 0;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Light &light : scene_.lights) {
      const auto brightness = static_cast<double>(luminance(light.emission));
      if (light.kind == kPointLight || light.kind == kSpotLight) without_extent += 1;
      if (light.kind > kDiskLight) continue;
      note_size(brightness, least, most);
      tiny += std::sqrt(static_cast<double>(light.area)) < kTinyLight * size && brightness > kBrightLight;
    }
    if (tiny > 0)
      add(count_of(tiny, "light is", "lights are") + " tiny and very bright",
          "they are sampled directly by the angle they fill; what glass or metal focuses of them is met by chance only: "
          "single bright samples are right, and take long to average out. --clamp cuts them, and makes the picture darker");
    const std::string glass = materials_that(description_, [](const MaterialDescription &m) {
      return m.kind == kDielectric || m.kind == kMirror;
    });
    if (without_extent > 0 && !glass.empty())
      add(count_of(without_extent, "light has", "lights have") + " no extent, and there is glass or a mirror: " + glass,
          "what only such lights send through it is not found: give them a radius");
    constexpr double kLargest = 1e25, kSmallest = 1e-25;
    if (most > kLargest || (least < kSmallest && least > 0))
      add(fmt::format("radiance from {:.2g} to {:.2g} W/sr/m^2", least, most),
          "single precision ends at 3e38 and 1e-38: samples beyond are counted, or 0");
  }

  void find_albedos() {
    const std::string white = materials_that(description_, [](const MaterialDescription &m) {
      const bool scatters = m.kind == kDiffuse || m.kind == kMirror || m.kind == kRoughDiffuse || m.kind == kPrincipled;
      return scatters && std::max({m.reflectance[0], m.reflectance[1], m.reflectance[2]}) >= 1;
    });
    if (white.empty()) return;
    add("reflects everything: " + white,
        fmt::format("no energy is lost by rounding, but roulette never ends such paths: they are cut off after {} scattering "
                    "events, and their light is missing",
                    description_.integrator.max_depth));
  }

  void find_indices() {
    const auto refracts = [](const MaterialDescription &m) {
      return m.kind == kDielectric || m.kind == kRoughDielectric || m.kind == kThinDielectric || m.kind == kCoated;
    };
    const std::string matched = materials_that(description_, [&](const MaterialDescription &m) {
      return refracts(m) && std::fabs(m.ior - 1) < 1e-4;
    });
    if (!matched.empty()) add("index of refraction next to 1: " + matched, "light passes straight through");
    const std::string extreme = materials_that(description_, [&](const MaterialDescription &m) {
      return refracts(m) && (m.ior > kExtremeIndex || m.ior < 1 / kExtremeIndex);
    });
    if (!extreme.empty())
      add("extreme index of refraction: " + extreme,
          "reflectance stays within 0 and 1; light inside is trapped for many events, see max_depth");
  }

  const SceneDescription &description_;
  const Scene &scene_;
  std::vector<Stiffness> found_;
};

}  // namespace

std::vector<Stiffness> find_stiffness(const SceneDescription &description, const Scene &scene) {
  return Finder(description, scene).find();
}

}  // namespace phalanx
