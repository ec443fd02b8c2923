// Lights of every kind, chosen in every way: what light.h does for plain area lights.
//
// Densities are per solid angle at the receiving point and include the choice of the light. Of lights at
// infinity, the environment map and discs (suns) are met by escaping rays, too; the constant environment is
// only met by those. Points, spots and lights of one direction are only found by sampling (is_delta).
#pragma once
#include "environment.h"
#include "light.h"
#include "light_profile.h"
#include "light_tree.h"
#include "mis.h"
#include "shape.h"
#include "solid_angle.h"
#include "texture.h"

PHALANX_BEGIN

// ---- which light ----------------------------------------------------------------------------------------

/// Probability that choose_light_rich() returns this light for `origin`.
PHYS float choice_pdf(const UNI SceneView &scene, Light light, Vec3 origin) {
  if (scene.num_light_nodes == 0 || light.kind >= kDirectionalLight) return light.select_pdf;
  return (1.0f - scene.infinite_share) * tree_pdf(scene, light.path, light.path_depth, origin);
}

/// One of the lights at infinity, by the part of the alias table that is theirs.
PHYS ChosenLight choose_infinite(const UNI SceneView &scene, float u, float v) {
  const int32 last = scene.num_lights - 1;
  const int32 first = scene.num_lights - scene.num_infinite_lights;
  int32 i = first + to_int(u * to_float(scene.num_infinite_lights));
  i = i < last ? i : last;
  ChosenLight c;
  c.light = v < scene.alias_threshold[i] ? i : scene.alias_other[i];
  c.pdf = scene.lights[c.light].select_pdf;
  return c;
}

PHYS ChosenLight choose_light_rich(const UNI SceneView &scene, Vec3 origin, Vec2 u) {
  ChosenLight c;
  if (scene.num_light_nodes == 0) {
    c.light = choose_light(scene, u);
    c.pdf = scene.lights[c.light].select_pdf;
    return c;
  }
  const float share = scene.infinite_share;
  if (u.x < share) return choose_infinite(scene, u.x / share, u.y);
  c = choose_in_tree(scene, origin, (u.x - share) / (1.0f - share), u.y);
  c.pdf = (1.0f - share) * c.pdf;
  return c;
}

// ---- surfaces -------------------------------------------------------------------------------------------

/// A point on a surface: its parameters are those of Light. solid_angle: 0 where drawn by area.
struct LightPoint {
  Vec3 position, normal;
  Vec2 at;
  float solid_angle;
};

/// What a light drawn by solid angle fills of the sphere around `origin`; 0 where it is drawn by area.
PHYS float sampled_solid_angle(Light light, Vec3 origin) {
  float omega = 0.0f;
  if (light.by_solid_angle != 0) {
    if (light.kind == kQuadLight) {
      const SphericalRectangle r =
          spherical_rectangle(light.p - origin, light.a, light.b, light.normal);
      omega = r.solid_angle;
    } else {
      const SphericalTriangle t =
          spherical_triangle(light.p - origin, light.a, light.b, light.normal, light.area);
      omega = t.solid_angle;
    }
  }
  return omega > PHALANX_MIN_SOLID_ANGLE ? omega : 0.0f;
}

/// Parameters of a quad's or triangle's point.
PHYS Vec2 sample_plane_light(Light light, Vec3 origin, float omega, Vec2 u) {
  if (light.kind == kQuadLight) {
    if (!(omega > 0.0f)) return u;
    return sample_spherical_rectangle(
        spherical_rectangle(light.p - origin, light.a, light.b, light.normal), u);
  }
  if (!(omega > 0.0f)) return square_to_triangle(u);
  return sample_spherical_triangle(
      spherical_triangle(light.p - origin, light.a, light.b, light.normal, light.area), u);
}

PHYS LightPoint sample_surface_light(Light light, Vec3 origin, Vec2 u) {
  LightPoint s;
  s.at = u;
  s.solid_angle = 0.0f;
  s.normal = light.normal;
  if (light.kind == kSphereLight) {
    s.position = sample_sphere_light(light, origin, u);
    s.normal = (s.position - light.p) * (1.0f / light.radius);
    return s;
  }
  if (light.kind == kDiskLight) {
    s.at = square_to_disk(u);
  } else {
    s.solid_angle = sampled_solid_angle(light, origin);
    s.at = sample_plane_light(light, origin, s.solid_angle, u);
  }
  s.position = light.p + light.a * s.at.x + light.b * s.at.y;
  return s;
}

/// Where textures are read at a point of a light; the same as at a hit there (surface.h).
PHYS TexturePoint light_texture_point(Light light, LightPoint s) {
  TexturePoint t;
  t.position = s.position;
  t.colour = vec3(1.0f, 1.0f, 1.0f);
  t.uv = s.at;
  if (light.kind == kSphereLight) t.uv = sphere_uv(s.normal);
  if (light.kind == kDiskLight) t.uv = disk_uv(s.at);
  if (light.kind == kTriangleLight) {
    t.uv = vec2(light.uv.x + light.uv_a.x * s.at.x + light.uv_b.x * s.at.y,
                light.uv.y + light.uv_a.y * s.at.x + light.uv_b.y * s.at.y);
    t.colour = light.colour + light.colour_a * s.at.x + light.colour_b * s.at.y;
  }
  return t;
}

/// Emission of a surface at one of its points, less what its opacity lets through.
PHYS Vec3 surface_emission(const UNI SceneView &scene, Light light, LightPoint s) {
  Vec3 emission = light.emission;
  if (light.emission_texture >= 0 || light.opacity_texture >= 0) {
    const TexturePoint at = light_texture_point(light, s);
    if (light.emission_texture >= 0)
      emission = emission * texture_value(scene, light.emission_texture, at);
    if (light.opacity_texture >= 0)
      emission = emission * clamp_to(texture_number(scene, light.opacity_texture, at), 0.0f, 1.0f);
  }
  return emission;
}

/// Density of a surface's point per solid angle at `origin`, the light being chosen.
PHYS float surface_pdf(Light light, Vec3 origin, Vec3 position, Vec3 n, float solid_angle) {
  if (solid_angle > 0.0f) return 1.0f / solid_angle;
  Light chosen = light;
  chosen.select_pdf = 1.0f;
  return light_pdf(chosen, origin, position, n);
}

PHYS LightSample sample_surface(const UNI SceneView &scene, Light light, Vec3 origin, Vec2 u) {
  const LightPoint point = sample_surface_light(light, origin, u);
  const Vec3 p = point.position;
  const Vec3 n = point.normal;
  const bool front = shows_front(light, origin, p, n);
  LightSample s;
  s.is_delta = 0;
  s.point = p;
  const Vec3 to_light = p + n * (front ? light.error : -light.error) - origin;
  s.distance = length(to_light);
  s.direction = to_light * (1.0f / s.distance);
  s.pdf = surface_pdf(light, origin, p, n, point.solid_angle);
  s.radiance = vec3(0.0f, 0.0f, 0.0f);
  if (front || light.two_sided != 0) s.radiance = surface_emission(scene, light, point);
  return s;
}

// ---- points and infinity --------------------------------------------------------------------------------

/// radiance: irradiance across the direction, W m^-2.
PHYS LightSample sample_point(const UNI SceneView &scene, Light light, Vec3 origin) {
  LightSample s;
  s.is_delta = 1;
  s.pdf = 1.0f;
  s.point = light.p;
  const Vec3 to_light = light.p - origin;
  s.distance = length(to_light);
  const float inverse = 1.0f / s.distance;
  s.direction = to_light * inverse;
  s.radiance = light.emission * inverse * inverse;
  if (light.kind == kSpotLight)
    s.radiance = s.radiance * spot_falloff(light, -dot(s.direction, light.normal));
  if (light.profile >= 0)
    s.radiance = s.radiance * profile_intensity(scene, light.profile, neg(s.direction));
  return s;
}

/// Draws a direction. One light only, or a disc, or the map; for the first, radiance is irradiance.
PHYS LightSample sample_infinite(const UNI SceneView &scene, Light light, Vec3 origin, Vec2 u) {
  LightSample s;
  s.is_delta = 0;
  s.pdf = 1.0f;
  s.radiance = light.emission;
  s.direction = light.normal;
  if (light.kind == kEnvironmentLight) {
    const EnvironmentSample e = sample_environment(scene, u);
    s.direction = e.direction;
    s.pdf = e.pdf;
    s.radiance = environment_radiance(scene, e.uv);
  } else if (light.one_minus_cos > 0.0f) {
    s.direction = to_world(make_frame(light.normal), square_to_cone(u, light.one_minus_cos));
    s.pdf = pdf_cone(light.one_minus_cos);
  } else {
    s.is_delta = 1;
  }
  s.distance = PHALANX_FAR;
  // So far out that its difference to the origin keeps the digits of the direction.
  s.point = origin + s.direction * (1.0f + 1024.0f * max_component(abs3(origin)));
  return s;
}

// ---- all of them ----------------------------------------------------------------------------------------

/// Samples the light that reaches `origin` directly. See LightSample; where is_delta is 1, pdf is only the
/// probability of the choice, and radiance is irradiance: the weight of such a sample is 1.
PHYS_CALL LightSample sample_light_rich(const UNI SceneView &scene, Vec3 origin, Vec2 u_choice,
                                        Vec2 u) {
  const ChosenLight choice = choose_light_rich(scene, origin, u_choice);
  const Light light = fetch(scene.lights, choice.light);
  LightSample s;
  if (light.kind < kPointLight)
    s = sample_surface(scene, light, origin, u);
  else if (light.kind < kDirectionalLight)
    s = sample_point(scene, light, origin);
  else
    s = sample_infinite(scene, light, origin, u);
  s.pdf = s.pdf * choice.pdf;
  if (!(s.distance > 0.0f) || !is_finite(s.pdf) || !all_finite(s.radiance)) s.pdf = 0.0f;
  return s;
}

/// Density of hitting `light`, a surface, at `position` (normal `n` there, unit) from `origin`.
PHYS_CALL float light_pdf_rich(const UNI SceneView &scene, Light light, Vec3 origin, Vec3 position,
                               Vec3 n) {
  return choice_pdf(scene, light, origin) *
         surface_pdf(light, origin, position, n, sampled_solid_angle(light, origin));
}

/// Weight of light met by a scattered ray of density bsdf_pdf (0: the camera or a delta), against having
/// sampled it from its source.
PHYS float escape_weight(float bsdf_pdf, float pdf) {
  return bsdf_pdf > 0.0f ? power_heuristic(bsdf_pdf, pdf) : 1.0f;
}

/// Radiance that comes from beyond the scene, against the unit vector `direction`, weighted for a ray that
/// was sampled with density bsdf_pdf at a surface; 0 for rays of the camera and of delta scattering.
PHYS_CALL Vec3 infinite_radiance(const UNI SceneView &scene, Vec3, Vec3 direction, float bsdf_pdf) {
  Vec3 sum = scene.environment;
  for (UNI int32 i = scene.num_lights - scene.num_infinite_lights; i < scene.num_lights; i++) {
    const Light light = scene.lights[i];
    if (light.kind == kEnvironmentLight) {
      const Vec2 uv = environment_uv(to_local(environment_frame(scene), direction));
      const float pdf = light.select_pdf * environment_pdf(scene, uv);
      sum = sum + environment_radiance(scene, uv) * escape_weight(bsdf_pdf, pdf);
    } else if (light.one_minus_cos > 0.0f) {
      // 1 - cos from the chord: the cosine itself has too few digits for a sun.
      const Vec3 chord = direction - light.normal;
      if (0.5f * dot(chord, chord) < light.one_minus_cos)
        sum = sum + light.emission *
                        escape_weight(bsdf_pdf, light.select_pdf * pdf_cone(light.one_minus_cos));
    }
  }
  return sum;
}

PHALANX_END
