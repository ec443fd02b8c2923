#include "build_materials.h"

#include <algorithm>
#include <cmath>

namespace phalanx {
namespace {

constexpr double kMinAlpha = 1e-3;

Vec3 to_vec3(const Double3 &v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// Reflectance of a metal at normal incidence, from its complex index of refraction eta + i k.
Double3 normal_reflectance(const Double3 &eta, const Double3 &k) {
  Double3 f0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double below = eta[i] - 1.0, above = eta[i] + 1.0, k2 = k[i] * k[i];
    f0[i] = (below * below + k2) / (above * above + k2);
  }
  return f0;
}

bool is_valid_emission(const Double3 &emission) {
  return std::all_of(emission.begin(), emission.end(),
                     [](double e) { return e >= 0 && e <= static_cast<double>(PHALANX_FAR); });
}

Material build_material(const MaterialDescription &from, std::vector<std::string> &notes) {
  Material material = {};
  material.kind = from.kind;
  material.reflectance = to_vec3(from.reflectance);
  material.eta = to_vec3(from.eta);
  material.k = to_vec3(from.k);
  material.has_ior = from.has_ior ? 1 : 0;
  material.ior = static_cast<float>(from.ior);
  if (is_valid_emission(from.emission)) material.emission = to_vec3(from.emission);
  material.two_sided = from.two_sided ? 1 : 0;
  const double alpha = from.roughness * from.roughness;
  material.alpha = static_cast<float>(std::clamp(alpha, kMinAlpha, 1.0));
  if (from.kind == kConductor && alpha < kMinAlpha) {
    material.kind = kMirror;
    notes.push_back("material '" + from.name + "' is smoother than roughness 0.0316: a mirror");
  }
  if (material.kind == kMirror && from.has_ior) {
    material.reflectance = to_vec3(normal_reflectance(from.eta, from.k));
    material.has_ior = 0;
  }
  return material;
}

}  // namespace

std::vector<Material> build_materials(const SceneDescription &description,
                                      std::vector<std::string> &notes, Diagnostics &diagnostics) {
  std::vector<Material> materials;
  materials.reserve(description.materials.size());
  for (std::size_t i = 0; i < description.materials.size(); ++i) {
    const MaterialDescription &from = description.materials[i];
    if (!is_valid_emission(from.emission))
      diagnostics.error(
          {description.file, 0, 0, "/materials/" + std::to_string(i) + "/emission",
           "material '" + from.name + "': emission must be finite, not negative and at most 3e38"});
    materials.push_back(build_material(from, notes));
  }
  return materials;
}

double emitted_luminance(const Material &material) {
  const Vec3 e = material.emission;
  return 0.2126 * static_cast<double>(e.x) + 0.7152 * static_cast<double>(e.y) +
         0.0722 * static_cast<double>(e.z);
}

}  // namespace phalanx
