// Every physics function as a row of numbers in and a row of numbers out: the same text for C++ and ISPC.
//
// A twin reads floats (in.f) and whole numbers (in.i) and returns floats; whole numbers come back as
// bits. TWIN_LIST names them all, with how many floats and whole numbers they read and how many
// floats they return. twin.ispc exports each, test_twin.cpp calls and compares them: a new physics
// function needs one function here and one line in the list.
#pragma once
#include "../../kernels/physics/estimator.h"
#include "../../kernels/physics/first_hit.h"

#define TWIN_MAX_FLOATS 16
#define TWIN_MAX_INTS 8
#define TWIN_MAX_RESULTS 32

//       name             floats ints results
#define TWIN_LIST(X)              \
  X(lang, 3, 0, 8)                \
  X(sincos, 1, 0, 2)              \
  X(transcendental, 2, 0, 8)      \
  X(hashes, 0, 3, 5)              \
  X(sample_pair, 0, 4, 3)         \
  X(samplers, 0, 4, 8)            \
  X(warps, 3, 0, 15)              \
  X(vectors, 6, 0, 15)            \
  X(frame, 6, 0, 12)              \
  X(affine, 15, 0, 12)            \
  X(fresnel, 6, 0, 6)             \
  X(ggx, 9, 0, 8)                 \
  X(diffuse, 9, 1, 12)            \
  X(mirror, 9, 1, 12)             \
  X(dielectric, 9, 1, 12)         \
  X(conductor, 9, 1, 12)          \
  X(rough_diffuse, 15, 1, 12)     \
  X(glossy_conductor, 15, 1, 12)  \
  X(rough_dielectric, 15, 1, 12)  \
  X(thin_dielectric, 15, 1, 12)   \
  X(coated, 15, 1, 12)            \
  X(phong, 15, 1, 12)             \
  X(blinn_phong, 15, 1, 12)       \
  X(hair, 15, 1, 12)              \
  X(principled, 15, 1, 12)        \
  X(camera, 1, 4, 8)              \
  X(wide_camera, 2, 1, 9)         \
  X(light_choice, 2, 0, 1)        \
  X(light_sample, 7, 0, 11)       \
  X(light_density, 9, 1, 1)       \
  X(rich_light_sample, 7, 0, 12)  \
  X(rich_light_density, 9, 1, 1)  \
  X(infinite_light, 4, 0, 3)      \
  X(solid_angle, 12, 0, 6)        \
  X(sphere, 12, 0, 4)             \
  X(disk, 8, 1, 5)                \
  X(plane, 15, 0, 5)              \
  X(surface, 6, 4, 20)            \
  X(first_hit, 6, 4, 7)           \
  X(curve, 7, 1, 20)              \
  X(motion, 13, 2, 13)            \
  X(heuristics, 5, 0, 2)          \
  X(noise, 3, 1, 3)               \
  X(wrap_texels, 1, 3, 3)         \
  X(texture, 8, 1, 5)             \
  X(relief, 14, 2, 3)             \
  X(textured, 8, 2, 11)           \
  X(start_path, 0, 3, 12)         \
  X(emission, 6, 4, 8)            \
  X(vertex_diffuse, 10, 7, 25)    \
  X(vertex_mirror, 10, 7, 25)     \
  X(vertex_dielectric, 10, 7, 25) \
  X(vertex_conductor, 10, 7, 25)  \
  X(vertex_black, 10, 7, 25)

PHALANX_BEGIN

struct TwinIn {
  float f[TWIN_MAX_FLOATS];
  int32 i[TWIN_MAX_INTS];
};

struct TwinOut {
  float f[TWIN_MAX_RESULTS];
};

#define TWIN_PLAIN(name) \
  PHYS TwinOut twin_##name(const UNI SceneView &, const UNI FrameView &, TwinIn in_)
#define F(k) in_.f[k]
#define F2(k) vec2(in_.f[k], in_.f[k + 1])
#define F3(k) vec3(in_.f[k], in_.f[k + 1], in_.f[k + 2])
#define PUT3(k, value)     \
  {                        \
    const Vec3 v_ = value; \
    r.f[k] = v_.x;         \
    r.f[k + 1] = v_.y;     \
    r.f[k + 2] = v_.z;     \
  }
#define PUT2(k, value)     \
  {                        \
    const Vec2 v_ = value; \
    r.f[k] = v_.x;         \
    r.f[k + 1] = v_.y;     \
  }
#define PUT_INT(k, n) r.f[k] = float_from_bits(n)

TWIN_PLAIN(lang) {
  TwinOut r;
  r.f[0] = min_of(F(0), F(1));
  r.f[1] = max_of(F(0), F(1));
  r.f[2] = clamp_to(F(0), F(1), F(2));
  r.f[3] = abs_of(F(0));
  r.f[4] = copy_sign(F(0), F(1));
  r.f[5] = safe_sqrt(F(0));
  r.f[6] = round_down(F(2));
  r.f[7] = is_finite(F(0)) ? 1.0f : 0.0f;
  return r;
}

TWIN_PLAIN(sincos) {
  const SinCos sc = sincos_turns(F(0));
  TwinOut r;
  r.f[0] = sc.sine;
  r.f[1] = sc.cosine;
  return r;
}

TWIN_PLAIN(transcendental) {
  TwinOut r;
  r.f[0] = exp_of(F(0));
  r.f[1] = log_of(abs_of(F(0)));
  r.f[2] = pow_of(abs_of(F(0)), F(1));
  r.f[3] = atan2_turns(F(0), F(1));
  r.f[4] = acos_of(F(0));
  r.f[5] = asin_of(F(1));
  r.f[6] = one_minus_exp(abs_of(F(0)));
  r.f[7] = neg_log_1m(clamp_to(F(1), 0.0f, 1.0f));
  return r;
}

TWIN_PLAIN(hashes) {
  const uint32 a = (uint32)in_.i[0];
  TwinOut r;
  PUT_INT(0, (int32)hash32(a));
  PUT_INT(1, (int32)reverse_bits(a));
  PUT_INT(2, (int32)scramble_reversed(a, (uint32)in_.i[1]));
  PUT_INT(3, (int32)sobol_second_reversed(a));
  PUT_INT(4, (int32)pixel_scramble(in_.i[0], in_.i[1], in_.i[2]));
  return r;
}

PHYS TwinOut twin_sample_pair(const UNI SceneView &, const UNI FrameView &frame, TwinIn in_) {
  TwinOut r;
  PUT2(0, sample_pair(frame, (uint32)in_.i[0], in_.i[1] & 0x3fffffff, in_.i[2] & 1023))
  r.f[2] = unit_float((uint32)in_.i[0]);
  return r;
}

PHYS TwinOut twin_samplers(const UNI SceneView &, const UNI FrameView &frame, TwinIn in_) {
  const uint32 h = (uint32)in_.i[0];
  const int32 index = in_.i[1] & 0x3fffffff;
  TwinOut r;
  PUT2(0, stratified_pair(frame, h, index))
  PUT2(2, halton_pair(frame, h, index, in_.i[2] & 127))
  PUT2(4, blue_noise_pair(frame, h & 0xfffffu, index, in_.i[2] & 1023))
  PUT_INT(6, (int32)pixel_scramble(frame, in_.i[2] & 0xffff, in_.i[3] & 0xffff));
  PUT_INT(7, permuted<5>(index & 0xfffff, 1 + ((index & 0xfffff) | (in_.i[3] & 0xfffff)), h));
  return r;
}

TWIN_PLAIN(warps) {
  const Vec2 u = F2(0);
  TwinOut r;
  PUT2(0, square_to_disk(u))
  PUT3(2, square_to_cosine_hemisphere(u))
  PUT3(5, square_to_sphere(u))
  PUT3(8, square_to_cone(u, F(2)))
  PUT2(11, square_to_triangle(u))
  r.f[13] = one_minus_cos_from_sin2(min_of(F(2), 1.0f));
  r.f[14] = pdf_cone(F(2)) + pdf_cosine_hemisphere(F(0)) + pdf_sphere();
  return r;
}

TWIN_PLAIN(vectors) {
  const Vec3 a = F3(0);
  const Vec3 b = F3(3);
  TwinOut r;
  PUT3(0, safe_normalize(a, b))
  PUT3(3, normalize(b))
  PUT3(6, cross(a, b) + neg(a) * b - max3(a, abs3(b)))
  r.f[9] = dot(a, b);
  r.f[10] = length(a);
  r.f[11] = length_squared(b);
  r.f[12] = max_component(a);
  r.f[13] = luminance(b);
  r.f[14] = (is_black(a) ? 1.0f : 0.0f) + (all_finite(b) ? 2.0f : 0.0f);
  return r;
}

TWIN_PLAIN(frame) {
  const Frame f = make_frame(F3(0));
  TwinOut r;
  PUT3(0, f.s)
  PUT3(3, f.t)
  PUT3(6, to_local(f, F3(3)))
  PUT3(9, to_world(f, F3(3)))
  return r;
}

TWIN_PLAIN(affine) {
  Affine m;
  m.m00 = F(0);
  m.m01 = F(1);
  m.m02 = F(2);
  m.m03 = F(3);
  m.m10 = F(4);
  m.m11 = F(5);
  m.m12 = F(6);
  m.m13 = F(7);
  m.m20 = F(8);
  m.m21 = F(9);
  m.m22 = F(10);
  m.m23 = F(11);
  TwinOut r;
  PUT3(0, transform_point(m, F3(12)))
  PUT3(3, transform_vector(m, F3(12)))
  PUT3(6, transform_transposed(m, F3(12)))
  PUT3(9, transform_abs(m, F3(12)))
  return r;
}

TWIN_PLAIN(fresnel) {
  const Refraction d = fresnel_dielectric(F(0), F(1));
  TwinOut r;
  r.f[0] = d.reflectance;
  r.f[1] = d.cos_t;
  r.f[2] = fresnel_conductor(F(0), F(1), F(2));
  PUT3(3, fresnel_schlick(F(0), F3(3)))
  return r;
}

TWIN_PLAIN(ggx) {  // wo, wi, alpha, u
  const float alpha = F(6);
  const Vec3 m = sample_ggx_visible(F3(0), alpha, F2(7));
  TwinOut r;
  PUT3(0, m)
  r.f[3] = ggx_d(m, alpha);
  r.f[4] = ggx_lambda(F3(3), alpha);
  r.f[5] = ggx_g1(F3(0), alpha);
  r.f[6] = ggx_g2(F3(0), F3(3), alpha);
  r.f[7] = pdf_ggx_visible(F3(0), m, alpha);
  return r;
}

/// The material `index` as it is, but for the roughness of rough ones.
PHYS Material twin_material(const UNI SceneView &scene, int32 index, float alpha) {
  Material m = fetch(scene.materials, index);
  m.alpha = alpha;
  return m;
}

template <int Kind>
PHYS TwinOut twin_scattering(const UNI SceneView &scene, Material m, TwinIn in_, float u_lobe) {
  const int32 front = in_.i[0] & 1;
  const BsdfSample s = sample_bsdf<Kind>(scene, m, front, F3(0), F2(6), u_lobe);
  const BsdfValue v = eval_bsdf<Kind>(scene, m, front, F3(0), F3(3));
  TwinOut r;
  PUT3(0, s.wi)
  PUT3(3, s.weight)
  r.f[6] = s.pdf;
  PUT3(7, v.f_cos)
  r.f[10] = v.pdf;
  r.f[11] = has_density<Kind>() ? 1.0f : 0.0f;
  return r;
}

template <int Kind>
PHYS TwinOut twin_bsdf(const UNI SceneView &scene, TwinIn in_) {  // wo, wi, u, alpha; material
  return twin_scattering<Kind>(scene, twin_material(scene, in_.i[0], F(8)), in_, F(7));
}

/// Rich kinds: the same, then index of refraction, two roughnesses, three numbers in [0,1]. Tables are those
/// of the toy scene.
template <int Kind>
PHYS TwinOut twin_rich_bsdf(const UNI SceneView &scene, TwinIn in_) {
  Material m = twin_material(scene, in_.i[0], F(8));
  m.ior = F(9);
  m.alpha_x = F(10);
  m.alpha_y = F(11);
  m.roughness = F(12);
  m.specular = vec3(F(13), F(12), 1.0f);
  m.transmittance = vec3(F(12), 1.0f, F(13));
  m.compensate = in_.i[0] & 1;
  m.table = 0;
  return twin_scattering<Kind>(scene, m, in_, F(14));
}
#define TWIN_BSDF(name, kind)                                                               \
  PHYS TwinOut twin_##name(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) { \
    return twin_bsdf<kind>(scene, in_);                                                     \
  }
TWIN_BSDF(diffuse, kDiffuse)
TWIN_BSDF(mirror, kMirror)
TWIN_BSDF(dielectric, kDielectric)
TWIN_BSDF(conductor, kConductor)
#define TWIN_RICH_BSDF(name, kind)                                                          \
  PHYS TwinOut twin_##name(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) { \
    return twin_rich_bsdf<kind>(scene, in_);                                                \
  }
TWIN_RICH_BSDF(rough_diffuse, kRoughDiffuse)
TWIN_RICH_BSDF(glossy_conductor, kGlossyConductor)
TWIN_RICH_BSDF(rough_dielectric, kRoughDielectric)
TWIN_RICH_BSDF(thin_dielectric, kThinDielectric)
TWIN_RICH_BSDF(coated, kCoated)

/// The same inputs for models of many lobes; shares of lobes are often 0 or 1.
template <int Kind>
PHYS TwinOut twin_layered_bsdf(const UNI SceneView &scene, TwinIn in_) {
  const Vec3 u = F3(12);
  Material m = twin_material(scene, in_.i[0], F(8));
  m.ior = max_of(F(9), 1.0f);
  m.exponent = 1e5f * u.x * u.x * u.x * u.x;
  m.roughness = u.x;
  m.tilt = 0.4f * u.y - 0.2f;
  m.transmittance = vec3(0.0f, 10.0f * u.y, 1.0f);
  m.specular = vec3(u.y, u.x, 1.0f);
  m.specular_level = u.y;
  m.metallic = clamp_to(2.0f * u.x - 0.5f, 0.0f, 1.0f);
  m.transmission = clamp_to(2.0f * u.y - 0.5f, 0.0f, 1.0f);
  m.clearcoat = clamp_to(3.0f * u.x - 2.0f, 0.0f, 1.0f);
  m.sheen = vec3(clamp_to(3.0f * u.y - 2.0f, 0.0f, 1.0f), 0.0f, 0.0f);
  m.clearcoat_alpha = F(10);
  m.sheen_alpha = F(11);
  m.table = 0;
  return twin_scattering<Kind>(scene, m, in_, u.z);
}
#define TWIN_LAYERED_BSDF(name, kind)                                                       \
  PHYS TwinOut twin_##name(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) { \
    return twin_layered_bsdf<kind>(scene, in_);                                             \
  }
TWIN_LAYERED_BSDF(phong, kPhong)
TWIN_LAYERED_BSDF(blinn_phong, kBlinnPhong)
TWIN_LAYERED_BSDF(hair, kHair)
TWIN_LAYERED_BSDF(principled, kPrincipled)

PHYS TwinOut twin_camera(const UNI SceneView &, const UNI FrameView &frame, TwinIn in_) {
  const Ray ray =
      camera_ray(frame, in_.i[0] & 63, in_.i[1] & 63, (uint32)in_.i[2], in_.i[3] & 0xffff);
  TwinOut r;
  PUT3(0, ray.origin)
  PUT3(3, ray.direction)
  r.f[6] = filter_offset(frame, F(0));
  r.f[7] = ray.weight;
  return r;
}

/// The point of the picture is spread over three half heights: beyond the edges, too.
PHYS TwinOut twin_wide_camera(const UNI SceneView &, const UNI FrameView &frame, TwinIn in_) {
  const Ray ray = wide_ray(frame, 3.0f * F(0) - 1.5f, 3.0f * F(1) - 1.5f, 1.25f);
  TwinOut r;
  PUT3(0, ray.origin)
  PUT3(3, ray.direction)
  r.f[6] = ray.weight;
  PUT2(7, square_to_polygon(F2(0), 3 + (in_.i[0] & 15), 0.3f))
  return r;
}

PHYS TwinOut twin_light_choice(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  TwinOut r;
  PUT_INT(0, choose_light(scene, F2(0)));
  return r;
}

PHYS TwinOut twin_light_sample(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  const LightSample s = sample_light(scene, F3(0), F2(3), F2(5));
  TwinOut r;
  PUT3(0, s.point)
  PUT3(3, s.direction)
  r.f[6] = s.distance;
  r.f[7] = s.pdf;
  PUT3(8, s.radiance)
  return r;
}

PHYS TwinOut twin_light_density(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  TwinOut r;
  r.f[0] = light_pdf(fetch(scene.lights, in_.i[0] % scene.num_lights), F3(0), F3(3), F3(6));
  return r;
}

PHYS TwinOut twin_rich_light_sample(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  const LightSample s = sample_light_rich(scene, F3(0), F2(3), F2(5));
  TwinOut r;
  PUT3(0, s.point)
  PUT3(3, s.direction)
  r.f[6] = s.distance;
  r.f[7] = s.pdf;
  PUT3(8, s.radiance)
  PUT_INT(11, s.is_delta);
  return r;
}

PHYS TwinOut twin_rich_light_density(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  TwinOut r;
  const Light light = fetch(scene.lights, in_.i[0] % scene.num_lights);
  r.f[0] = light_pdf_rich(scene, light, F3(0), F3(3), F3(6));
  return r;
}

PHYS TwinOut twin_infinite_light(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  TwinOut r;
  PUT3(0, infinite_radiance(scene, F3(0), normalize(F3(0)), F(3)))
  return r;
}

TWIN_PLAIN(solid_angle) {
  const Frame f = make_frame(normalize(F3(3)));
  const Vec3 a = f.s * (0.1f + abs_of(F(6)));
  const Vec3 b = f.t * (0.1f + abs_of(F(7)));
  const SphericalRectangle rectangle = spherical_rectangle(F3(0), a, b, f.n);
  const SphericalTriangle triangle =
      spherical_triangle(F3(0), a, b, f.n, 0.5f * length(a) * length(b));
  TwinOut r;
  r.f[0] = rectangle.solid_angle;
  r.f[1] = triangle.solid_angle;
  PUT2(2, sample_spherical_rectangle(rectangle, F2(8)))
  PUT2(4, sample_spherical_triangle(triangle, F2(10)))
  return r;
}

TWIN_PLAIN(sphere) {
  Sphere s;
  s.center = F3(6);
  s.radius = F(9);
  const ShapeHit hit = intersect_sphere(F3(0), F3(3), s, F(10), F(11));
  TwinOut r;
  r.f[0] = hit.t;
  PUT_INT(1, hit.far_root);
  r.f[2] = sphere_root(F3(0), F3(3), s, 0);
  r.f[3] = sphere_root(F3(0), F3(3), s, 1);
  return r;
}

PHYS TwinOut twin_disk(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  const Disk d = scene.disks[in_.i[0]];
  const ShapeHit hit = intersect_disk(F3(0), F3(3), d, F(6), F(7));
  TwinOut r;
  r.f[0] = hit.t;
  PUT_INT(1, hit.far_root);
  r.f[2] = disk_plane_distance(F3(0), F3(3), d);
  PUT2(3, disk_coordinates(F3(0), d))
  return r;
}

TWIN_PLAIN(plane) {
  const PlanePoint p = meet_plane(F3(0), F3(3), F3(6), F3(9), F3(12));
  TwinOut r;
  PUT3(0, p.normal)
  r.f[3] = p.u;
  r.f[4] = p.v;
  return r;
}

PHYS Hit twin_hit(TwinIn in_) {
  Hit hit;
  hit.geometry = in_.i[0];
  hit.primitive = in_.i[1];
  hit.instance = in_.i[2];
  hit.far_root = in_.i[3];
  hit.u = 0.0f;
  return hit;
}

PHYS TwinOut twin_surface(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  const Surface s = make_surface<kPlain>(scene, twin_hit(in_), F3(0), F3(3));
  TwinOut r;
  PUT3(0, s.position)
  PUT3(3, s.normal)
  PUT3(6, s.shading.s)
  PUT3(9, s.shading.t)
  PUT3(12, s.shading.n)
  r.f[15] = s.offset;
  PUT_INT(16, (s.front * 256 + s.material) * 65536 + s.light);
  PUT3(17, spawn_origin(s, F3(3)))
  return r;
}

PHYS TwinOut twin_curve(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  Geometry g;
  g.first = 0;
  Hit hit;
  hit.primitive = in_.i[0] & 1;
  hit.u = copy_sign(F(6), in_.i[0] < 0 ? -1.0f : 1.0f);
  const LocalSurface l = curve_surface(scene, g, hit, F3(0), F3(3));
  Surface s;
  s.position = l.position;
  s.normal = l.normal;
  s.dpdu = l.dpdu;
  s.thickness = l.thickness;
  s.front = 1;
  s.offset = 1e-3f;
  s.shading = textured_frame(l.normal, l.dpdu, l.dpdv);
  TwinOut r;
  PUT3(0, l.position)
  PUT3(3, l.normal)
  PUT3(6, l.dpdu)
  PUT3(9, l.dpdv)
  PUT2(12, l.uv)
  PUT3(14, spawn_beyond(s, F3(3)))
  PUT3(17, s.shading.t)
  return r;
}

PHYS TwinOut twin_motion(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  Affine a = scene.instances[0].to_world;
  Affine b = a;
  b.m00 = F(0);
  b.m01 = F(1);
  b.m02 = F(2);
  b.m10 = F(3);
  b.m11 = F(4);
  b.m12 = F(5);
  b.m20 = F(6);
  b.m21 = F(7);
  b.m22 = F(8);
  b.m03 = F(9);
  b.m13 = F(10);
  b.m23 = F(11);
  const Affine m = inverse_affine(mix_affine(a, b, F(12)));
  TwinOut r;
  PUT3(0, vec3(m.m00, m.m01, m.m02))
  PUT3(3, vec3(m.m10, m.m11, m.m12))
  PUT3(6, vec3(m.m20, m.m21, m.m22))
  PUT3(9, vec3(m.m03, m.m13, m.m23))
  const Vec2 time = sobol_pair(hash32((uint32)in_.i[0]), in_.i[1] & 0xffff);
  r.f[12] = time.x;
  return r;
}

PHYS TwinOut twin_first_hit(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  Hit hit = twin_hit(in_);
  if (F(0) > 2.5f) hit.geometry = -1;  // some rays leave the scene
  const FirstHit f = first_hit<kPlain>(scene, hit, F3(0), F3(3));
  TwinOut r;
  PUT3(0, f.albedo)
  PUT3(3, f.normal)
  r.f[6] = f.depth;
  return r;
}

TWIN_PLAIN(heuristics) {
  TwinOut r;
  r.f[0] = power_heuristic(F(0), F(1));
  r.f[1] = survival_probability(F3(2));
  return r;
}

TWIN_PLAIN(noise) {
  const int32 octaves = in_.i[0] & 7;
  TwinOut r;
  r.f[0] = gradient_noise(F3(0));
  r.f[1] = fractal_noise(F3(0), octaves, false);
  r.f[2] = fractal_noise(F3(0), octaves, true);
  return r;
}

TWIN_PLAIN(wrap_texels) {
  const TexelPair pair = wrap_texels(F(0), in_.i[0], in_.i[1], in_.i[2]);
  TwinOut r;
  PUT_INT(0, pair.first);
  PUT_INT(1, pair.second);
  r.f[2] = pair.t;
  return r;
}

/// uv, position, colour from floats 0-7.
PHYS TexturePoint twin_texture_point(TwinIn in_) {
  TexturePoint at;
  at.uv = F2(0);
  at.position = F3(2);
  at.colour = F3(5);
  return at;
}

PHYS TwinOut twin_texture(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  const Texel texel = texture_texel(scene, in_.i[0], twin_texture_point(in_));
  TwinOut r;
  PUT3(0, texel.colour)
  r.f[3] = texel.alpha;
  r.f[4] = texture_number(scene, in_.i[0], twin_texture_point(in_));
  return r;
}

/// dpdu, dpdv from floats 8-13; normal map, bump map.
PHYS TwinOut twin_relief(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  Material m = fetch(scene.materials, 0);
  m.normal_texture = in_.i[0];
  m.bump_texture = in_.i[1];
  const Frame frame = make_frame(vec3(0.6f, 0.0f, 0.8f));
  TwinOut r;
  Tangents tangents;
  tangents.dpdu = F3(8);
  tangents.dpdv = F3(11);
  tangents.solid_s = frame.s * F(8);
  tangents.solid_t = frame.t * F(9);
  PUT3(0, mapped_normal(scene, m, frame, twin_texture_point(in_), tangents))
  return r;
}

PHYS TwinOut twin_textured(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  Material m = fetch(scene.materials, in_.i[1] & 1);
  m.textured = 1;
  m.reflectance_texture = in_.i[0];
  m.transmittance_texture = in_.i[0];
  m.roughness_texture = in_.i[0];
  m.metallic_texture = in_.i[0];
  const Material t = textured_material(scene, m, twin_texture_point(in_));
  TwinOut r;
  PUT3(0, t.reflectance)
  PUT3(3, t.transmittance)
  r.f[6] = t.roughness;
  r.f[7] = t.alpha;
  r.f[8] = t.alpha_x;
  r.f[9] = t.alpha_y;
  r.f[10] = t.metallic;
  return r;
}

PHYS TwinOut twin_path(PathState p) {
  TwinOut r;
  PUT3(0, p.origin)
  PUT3(3, p.direction)
  PUT3(6, p.throughput)
  r.f[9] = p.pdf;
  PUT_INT(10, p.depth);
  PUT_INT(11, p.scramble ^ p.sample);
  return r;
}

PHYS TwinOut twin_start_path(const UNI SceneView &, const UNI FrameView &frame, TwinIn in_) {
  return twin_path(start_path(frame, in_.i[0] & 63, in_.i[1] & 63, in_.i[2] & 0xffff));
}

/// Ray, throughput and pdf from floats 0-9; hit from whole numbers 0-3, then depth, scramble, sample.
PHYS PathState twin_state(TwinIn in_) {
  PathState p;
  p.origin = F3(0);
  p.direction = F3(3);
  p.throughput = F3(6);
  p.pdf = F(9);
  p.depth = in_.i[4];
  p.scramble = in_.i[5];
  p.sample = in_.i[6];
  return p;
}

PHYS TwinOut twin_emission(const UNI SceneView &scene, const UNI FrameView &, TwinIn in_) {
  const Hit hit = twin_hit(in_);
  PathState p = twin_state(in_);
  p.pdf = F(0) > 0.0f ? 0.7f : 0.0f;
  p.throughput = F3(0);
  const Surface s = make_surface<kPlain>(scene, hit, F3(0), F3(3));
  TwinOut r;
  PUT3(0, escaped_radiance<kPlain>(scene, p))
  PUT3(3, emitted_radiance<kPlain>(scene, fetch(scene.materials, s.material), s))
  r.f[6] = 0.0f;
  if (s.light >= 0) r.f[6] = emission_weight<kPlain>(scene, p, s);
  r.f[7] = offset_bound(abs3(F3(0)), s.normal);
  return r;
}

PHYS TwinOut twin_vertex(Vertex v) {
  TwinOut r = twin_path(v.next);
  PUT3(12, v.emitted)
  PUT3(15, v.shadow.contribution)
  // The ray means something only where it carries light.
  const bool lit = !is_black(v.shadow.contribution);
  const Vec3 none = vec3(0.0f, 0.0f, 0.0f);
  Vec3 origin = none;
  Vec3 direction = none;
  float distance = 0.0f;
  if (lit) {
    origin = v.shadow.origin;
    direction = v.shadow.direction;
    distance = v.shadow.distance;
  }
  PUT3(18, origin)
  PUT3(21, direction)
  r.f[24] = distance;
  return r;
}

#define TWIN_VERTEX(name, kind)                                                                  \
  PHYS TwinOut twin_##name(const UNI SceneView &scene, const UNI FrameView &frame, TwinIn in_) { \
    return twin_vertex(path_vertex<kind, kPlain>(scene, frame, twin_state(in_), twin_hit(in_)));         \
  }
TWIN_VERTEX(vertex_diffuse, kDiffuse)
TWIN_VERTEX(vertex_mirror, kMirror)
TWIN_VERTEX(vertex_dielectric, kDielectric)
TWIN_VERTEX(vertex_conductor, kConductor)
TWIN_VERTEX(vertex_black, kBlack)

// path_vertex_any is not here: five kinds in one take ISPC 40 s for sse4. The megakernel is made of
// it, and compared with the depth-first twin by tests/wavefront.

#undef TWIN_PLAIN
#undef TWIN_BSDF
#undef TWIN_RICH_BSDF
#undef TWIN_VERTEX
#undef F
#undef F2
#undef F3
#undef PUT2
#undef PUT3
#undef PUT_INT

PHALANX_END
