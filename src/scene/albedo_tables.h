// Makes the tables of directional albedos that some materials need (kernels/physics/albedo_table.h).
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace phalanx {

/// Appends tables to Scene::tables, each only once. All return the index of a table's first float.
class AlbedoTables {
 public:
  explicit AlbedoTables(std::vector<float> &tables) : tables_(tables) {}

  /// Single scattering of white GGX microfacets; rows are sqrt(alpha).
  std::int32_t microfacets();
  /// The same with roughness alpha_x along the tangent and alpha_y across, which are not equal; rows
  /// are azimuths as in glossy_row().
  std::int32_t microfacets(float alpha_x, float alpha_y);
  /// Reflection of a dielectric from outside, ior > 0; rows are sqrt(alpha), row 0 is smooth.
  std::int32_t dielectric(float ior);
  /// The three tables of bsdf_principled.h. Their numbers are raised until the tables are nowhere below
  /// the albedos: what is below a layer never gets more light than the layer leaves.
  std::int32_t principled();

 private:
  template <typename Make>
  std::int32_t find_or_make(const std::array<float, 3> &key, const Make &make);

  std::vector<float> &tables_;
  std::map<std::array<float, 3>, std::int32_t> made_;
};

/// Average over the hemisphere of the reflectance of a metal with index eta + i k, one channel.
double average_fresnel(double eta, double k);

}  // namespace phalanx
