// The parameters of a material at a point: constants, or textures in their place.
#pragma once
#include "texture.h"

PHALANX_BEGIN

/// GGX roughness of a perceptual one, as build_materials.cpp has it.
PHYS float alpha_of_roughness(float roughness) {
  return clamp_to(roughness * roughness, 1.0e-3f, 1.0f);
}

/// A texture's colour where there is a texture, else `constant`. A part of light: in [0, 1].
PHYS Vec3 textured_part(const UNI SceneView &scene, int32 texture, Vec3 constant, TexturePoint at) {
  if (texture < 0) return constant;
  const Vec3 c = texture_value(scene, texture, at);
  return vec3(min_of(c.x, 1.0f), min_of(c.y, 1.0f), min_of(c.z, 1.0f));
}

PHYS float textured_part(const UNI SceneView &scene, int32 texture, float constant,
                         TexturePoint at) {
  if (texture < 0) return constant;
  return clamp_to(texture_number(scene, texture, at), 0.0f, 1.0f);
}

/// The material with the values of its textures at a point of the surface. Roughness keeps the ratio of
/// its two directions. Emission, opacity, the weight of blends and normals are looked up where they
/// are used.
PHYS Material textured_material(const UNI SceneView &scene, Material m, TexturePoint at) {
  if (m.textured == 0) return m;
  Material r = m;
  r.reflectance = textured_part(scene, m.reflectance_texture, m.reflectance, at);
  r.specular = textured_part(scene, m.specular_texture, m.specular, at);
  r.transmittance = textured_part(scene, m.transmittance_texture, m.transmittance, at);
  r.sheen = textured_part(scene, m.sheen_texture, m.sheen, at);
  r.metallic = textured_part(scene, m.metallic_texture, m.metallic, at);
  r.transmission = textured_part(scene, m.transmission_texture, m.transmission, at);
  r.clearcoat = textured_part(scene, m.clearcoat_texture, m.clearcoat, at);
  if (m.roughness_texture >= 0) {
    r.roughness = textured_part(scene, m.roughness_texture, 0.0f, at);
    r.alpha = alpha_of_roughness(r.roughness);
    const float ratio = m.alpha > 0.0f ? r.alpha / m.alpha : 0.0f;
    r.alpha_x = clamp_to(m.alpha_x * ratio, 1.0e-3f, 1.0f);
    r.alpha_y = clamp_to(m.alpha_y * ratio, 1.0e-3f, 1.0f);
  }
  return r;
}

PHALANX_END
