#include "build_materials.h"

#include <algorithm>
#include <cmath>

#include "albedo_tables.h"
#include "build_textures.h"

namespace phalanx {
namespace {

constexpr double kMinAlpha = 1e-3;  // PHALANX_LEAST_ALPHA
constexpr Double3 kWhite = {1, 1, 1};

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

double alpha_of(double roughness) { return roughness * roughness; }
float rough_alpha(double roughness) {
  return static_cast<float>(std::clamp(alpha_of(roughness), kMinAlpha, 1.0));
}

bool is_smooth(const MaterialDescription &from) {
  if (from.textures.roughness >= 0) return false;
  if (!from.anisotropic) return alpha_of(from.roughness) < kMinAlpha;
  return alpha_of(std::max(from.roughness_x, from.roughness_y)) < kMinAlpha;
}

bool is_tinted(const MaterialDescription &from) {
  return from.specular != kWhite || from.transmittance != kWhite || from.textures.specular >= 0 ||
         from.textures.transmittance >= 0;
}

/// The kind that the parameters ask for: the basic one where that will do.
MaterialKind kind_of(const MaterialDescription &from) {
  if (from.kind == kConductor) {
    if (is_smooth(from)) return kMirror;
    const bool is_anisotropic = from.anisotropic && from.roughness_x != from.roughness_y;
    const bool is_glossy =
        is_anisotropic || from.multiple_scattering || from.textures.roughness >= 0;
    return is_glossy ? kGlossyConductor : kConductor;
  }
  if (from.kind == kDielectric)
    return is_smooth(from) && !is_tinted(from) ? kDielectric : kRoughDielectric;
  return from.kind;
}

void set_roughness(const MaterialDescription &from, Material &material) {
  material.roughness = static_cast<float>(from.roughness);
  material.alpha_x = rough_alpha(from.anisotropic ? from.roughness_x : from.roughness);
  material.alpha_y = rough_alpha(from.anisotropic ? from.roughness_y : from.roughness);
  material.alpha = from.anisotropic ? std::sqrt(material.alpha_x * material.alpha_y)
                                    : rough_alpha(from.roughness);
  const bool has_delta = material.kind == kRoughDielectric || material.kind == kCoated;
  if (has_delta && is_smooth(from)) material.alpha = 0;
}

/// What a metal's colour needs beyond its description.
void set_metal(const MaterialDescription &from, Material &material) {
  if (material.kind == kMirror && from.has_ior) {
    material.reflectance = to_vec3(normal_reflectance(from.eta, from.k));
    material.has_ior = 0;
  }
  if (material.kind == kGlossyConductor && from.has_ior) {
    Double3 average;
    for (std::size_t i = 0; i < 3; ++i) average[i] = average_fresnel(from.eta[i], from.k[i]);
    material.reflectance = to_vec3(average);
  }
}

void set_principled(const MaterialDescription &from, Material &material) {
  material.specular_level = static_cast<float>(from.specular_level);
  material.metallic = static_cast<float>(from.metallic);
  material.transmission = static_cast<float>(from.transmission);
  material.clearcoat = static_cast<float>(from.clearcoat);
  material.clearcoat_alpha = rough_alpha(from.clearcoat_roughness);
  material.sheen = to_vec3(from.sheen);
  material.sheen_alpha = rough_alpha(from.sheen_roughness);
}

/// Absorption of hair per radius from its colour, and back: Chiang et al. 2016, eq. 9.
double absorption_divisor(double azimuthal_roughness) {
  const double b = azimuthal_roughness;
  return 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
}

void set_hair(const MaterialDescription &from, Material &material) {
  constexpr double kBlackest = 1e-6;
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const double divisor = absorption_divisor(from.azimuthal_roughness);
  Double3 colour = from.reflectance, absorption = from.absorption;
  for (std::size_t i = 0; i < 3; ++i)
    if (from.has_absorption)
      colour[i] = std::exp(-divisor * std::sqrt(absorption[i]));
    else
      absorption[i] = std::pow(std::log(std::max(colour[i], kBlackest)) / divisor, 2);
  material.reflectance = to_vec3(colour);
  material.transmittance = to_vec3(absorption);
  material.alpha = static_cast<float>(from.azimuthal_roughness);
  material.tilt = static_cast<float>(std::sin(from.tilt * kDegree));
}

void set_table(AlbedoTables &tables, Material &material) {
  const float x = material.alpha_x, y = material.alpha_y;
  if (material.kind == kCoated) material.table = tables.dielectric(material.ior);
  if (material.kind == kGlossyConductor && material.compensate != 0)
    material.table = x == y ? tables.microfacets() : tables.microfacets(x, y);
  if (material.kind == kPrincipled) material.table = tables.principled();
}

Material build_material(const MaterialDescription &from, AlbedoTables &tables,
                        std::vector<std::string> &notes) {
  Material material = blank_material();
  material.kind = kind_of(from);
  material.reflectance = to_vec3(from.reflectance);
  material.eta = to_vec3(from.eta);
  material.k = to_vec3(from.k);
  material.has_ior = from.has_ior ? 1 : 0;
  material.ior = static_cast<float>(from.ior);
  material.specular = to_vec3(from.specular);
  material.transmittance = to_vec3(from.transmittance);
  material.compensate = from.multiple_scattering ? 1 : 0;
  if (is_valid_emission(from.emission)) material.emission = to_vec3(from.emission);
  material.two_sided = from.two_sided ? 1 : 0;
  material.one_sided = from.one_sided ? 1 : 0;
  material.exponent = static_cast<float>(from.exponent);
  material.blend_a = from.blend_a;
  material.blend_b = from.blend_b;
  material.weight = static_cast<float>(from.weight);
  material.opacity = static_cast<float>(from.opacity);
  set_textures(from, material);
  set_roughness(from, material);
  set_metal(from, material);
  if (from.kind == kPrincipled) set_principled(from, material);
  if (from.kind == kHair) set_hair(from, material);
  set_table(tables, material);
  if (from.kind == kConductor && material.kind == kMirror)
    notes.push_back("material '" + from.name + "' is smoother than roughness 0.0316: a mirror");
  return material;
}

}  // namespace

Material blank_material() {
  Material m = {};
  m.specular = m.transmittance = {1, 1, 1};
  m.specular_level = 1;
  m.table = m.blend_a = m.blend_b = -1;
  m.opacity = m.bump_scale = m.normal_scale = 1;
  m.reflectance_texture = m.specular_texture = m.transmittance_texture = m.roughness_texture = -1;
  m.metallic_texture = m.transmission_texture = m.clearcoat_texture = m.sheen_texture = -1;
  m.emission_texture = m.weight_texture = m.opacity_texture = m.normal_texture = -1;
  m.bump_texture = -1;
  return m;
}

std::vector<Material> build_materials(const SceneDescription &description,
                                      std::vector<float> &tables, std::vector<std::string> &notes,
                                      Diagnostics &diagnostics) {
  AlbedoTables albedo_tables(tables);
  std::vector<Material> materials;
  materials.reserve(description.materials.size());
  for (std::size_t i = 0; i < description.materials.size(); ++i) {
    const MaterialDescription &from = description.materials[i];
    if (!is_valid_emission(from.emission))
      diagnostics.error(
          {description.file, 0, 0, "/materials/" + std::to_string(i) + "/emission",
           "material '" + from.name + "': emission must be finite, not negative and at most 3e38"});
    materials.push_back(build_material(from, albedo_tables, notes));
  }
  return materials;
}

double emitted_luminance(const Material &material) {
  const Vec3 e = material.emission;
  return 0.2126 * static_cast<double>(e.x) + 0.7152 * static_cast<double>(e.y) +
         0.0722 * static_cast<double>(e.z);
}

}  // namespace phalanx
