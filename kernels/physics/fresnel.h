// Reflectance of smooth interfaces for unpolarised light.
#pragma once
#include "vec.h"

PHALANX_BEGIN

/// Reflectance of a dielectric interface from the cosines on both sides, not both 0. eta: index on the far
/// side over index on the near side.
PHYS float fresnel_reflectance(float cos_i, float cos_t, float eta) {
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// 1 - fresnel_reflectance(), which keeps its digits close to total reflection and at grazing angles.
PHYS float fresnel_transmittance(float cos_i, float cos_t, float eta) {
  const float parallel = 1.0f / (eta * cos_i + cos_t);
  const float perpendicular = 1.0f / (cos_i + eta * cos_t);
  return 2.0f * eta * cos_i * cos_t * (parallel * parallel + perpendicular * perpendicular);
}

struct Refraction {
  float reflectance;   // in [0,1]; exactly 1 under total internal reflection
  float cos_t;         // cosine of the transmitted direction, >= 0; 0 under total reflection
};

/// Dielectric interface. cos_i in [0,1]: angle of incidence. eta > 0: index on the far side over
/// index on the near side. eta = 1 reflects exactly nothing.
PHYS Refraction fresnel_dielectric(float cos_i, float eta) {
  Refraction r;
  // 1 - sin^2 / eta^2 cancels at grazing angles where eta is near 1; the other form where it is not.
  const float inv_eta2 = 1.0f / (eta * eta);
  const float cos2_t = abs_of(eta - 1.0f) < 0.1f
                           ? ((eta - 1.0f) * (eta + 1.0f) + cos_i * cos_i) * inv_eta2
                           : 1.0f - (1.0f - cos_i) * (1.0f + cos_i) * inv_eta2;
  if (cos2_t <= 0.0f) {
    r.reflectance = 1.0f;
    r.cos_t = 0.0f;
    return r;
  }
  r.cos_t = square_root(cos2_t);
  r.reflectance = fresnel_reflectance(cos_i, r.cos_t, eta);
  return r;
}

/// One channel of a conductor with complex index eta + i k (against vacuum). cos_i in [0,1].
/// Born and Wolf, section 14.2, in the form of Lagarde's "Memo on Fresnel equations" (2013).
PHYS float fresnel_conductor(float cos_i, float eta, float k) {
  const float c2 = cos_i * cos_i;
  const float s2 = max_of(1.0f - c2, 0.0f);
  const float t0 = eta * eta - k * k - s2;
  const float a2b2 = safe_sqrt(t0 * t0 + 4.0f * eta * eta * k * k);
  const float t1 = a2b2 + c2;
  const float a = safe_sqrt(0.5f * (a2b2 + t0));
  const float t2 = 2.0f * cos_i * a;
  const float rs = (t1 - t2) / (t1 + t2);
  const float t3 = c2 * a2b2 + s2 * s2;
  const float t4 = t2 * s2;
  const float rp = rs * (t3 - t4) / (t3 + t4);
  return clamp_to(0.5f * (rs + rp), 0.0f, 1.0f);
}

/// Schlick 1994: f0 + (1 - f0) (1 - cos)^5. cos_i in [0,1].
PHYS Vec3 fresnel_schlick(float cos_i, Vec3 f0) {
  const float m = clamp_to(1.0f - cos_i, 0.0f, 1.0f);
  const float m2 = m * m;
  const float m5 = m2 * m2 * m;
  return f0 + (vec3(1.0f, 1.0f, 1.0f) - f0) * m5;
}

PHALANX_END
