// Hair: reflection (R) and transmission (TT, TRT, the rest) by a dielectric cylinder with tilted scales.
// Chiang, Bitterli, Tappan and Burley, "A Practical and Controllable Hair and Fur Model for Production Path
// Tracing" (2016), after d'Eon et al. 2011 and as told by Pharr, "The Implementation of a Hair
// Scattering Model" (2016).
//
// Local frame: x along the hair, towards the tip; z the outer normal of the cylinder where the ray met it.
// Where across the hair that is, h = sin(gamma_o) in [-1, 1], follows from the angle between the normal
// and wo seen along the hair. Azimuths are turns from z towards y.
//
// The model relates whole hairs: light that falls on one from wi leaves it along wo, wherever it came in.
// So no cosine of the surface belongs to it: f cos here is sum of M A N, which integrates to sum of A (1
// without absorption) over the sphere. Averaged over the hair's width, as the rays that meet it are,
// that is the far-field model of d'Eon et al. wi may point to either side.
#pragma once
#include "bsdf_types.h"
#include "fresnel.h"
#include "warp.h"

PHALANX_BEGIN

#define PHALANX_HAIR_LOBES 4
/// Smaller roughnesses count as this: lobes of a quarter of a degree.
#define PHALANX_LEAST_HAIR_ROUGHNESS 0.02f

/// Everything that depends on wo alone. Per lobe: what it reflects (A) and its share of the samples, the
/// angle of wo against the tilted scales, its longitudinal variance, its azimuth against wo.
struct HairLobes {
  Vec3 attenuation[PHALANX_HAIR_LOBES];
  float share[PHALANX_HAIR_LOBES];
  float sin_o[PHALANX_HAIR_LOBES], cos_o[PHALANX_HAIR_LOBES];
  float variance[PHALANX_HAIR_LOBES];
  float azimuth[PHALANX_HAIR_LOBES];
  float scale;      // of the logistic distribution of azimuths, turns
  float azimuth_o;  // of wo
};

/// A_p of the paper, eq. 13 and after: Fresnel reflection f, transmittance t through the fibre.
PHYS Vec3 hair_attenuation(UNI int32 lobe, float f, Vec3 t) {
  const float passes = (1.0f - f) * (1.0f - f);
  if (lobe == 0) return vec3(f, f, f);
  if (lobe == 1) return t * passes;
  if (lobe == 2) return t * t * (passes * f);
  const Vec3 left = max3(vec3(1.0f, 1.0f, 1.0f) - t * f, vec3(1e-20f, 1e-20f, 1e-20f));
  return t * t * t * (passes * f * f) * vec3(1.0f / left.x, 1.0f / left.y, 1.0f / left.z);
}

/// Longitudinal variance of the lobe TT over a quarter, from roughness in [0, 1]: eq. 7.
PHYS float hair_variance(float roughness) {
  const float b = clamp_to(roughness, PHALANX_LEAST_HAIR_ROUGHNESS, 1.0f);
  const float b2 = b * b;
  const float b4 = b2 * b2;
  const float b16 = b4 * b4 * b4 * b4;
  const float root = 0.726f * b + 0.812f * b2 + 3.7f * b16 * b4;
  return root * root;
}

/// Scale of the logistic distribution of azimuths, turns, from roughness in [0, 1]: eq. 8.
PHYS float hair_logistic_scale(float roughness) {
  const float b = clamp_to(roughness, PHALANX_LEAST_HAIR_ROUGHNESS, 1.0f);
  const float b2 = b * b;
  const float b4 = b2 * b2;
  const float b16 = b4 * b4 * b4 * b4;
  // sqrt(pi / 8) / (2 pi)
  return 0.0997355701f * (0.265f * b + 1.194f * b2 + 5.372f * b16 * b4 * b2);
}

/// Sine and cosine of wo's angle against the scales, of which R sees it turned back by twice their tilt,
/// TT and TRT on by one and four times. `tilt`: its sine.
PHYS Vec2 tilted_against_scales(UNI int32 lobe, float tilt, float sin_o, float cos_o) {
  const float sin1 = tilt;
  const float cos1 = safe_sqrt(1.0f - tilt * tilt);
  const float sin2 = 2.0f * sin1 * cos1;
  const float cos2 = 1.0f - 2.0f * sin1 * sin1;
  const float sin4 = 2.0f * sin2 * cos2;
  const float cos4 = 1.0f - 2.0f * sin2 * sin2;
  if (lobe == 0) return vec2(sin_o * cos2 - cos_o * sin2, abs_of(cos_o * cos2 + sin_o * sin2));
  if (lobe == 1) return vec2(sin_o * cos1 + cos_o * sin1, abs_of(cos_o * cos1 - sin_o * sin1));
  if (lobe == 2) return vec2(sin_o * cos4 + cos_o * sin4, abs_of(cos_o * cos4 - sin_o * sin4));
  return vec2(sin_o, cos_o);
}

/// m.ior >= 1, m.transmittance: absorption per radius of the hair, m.tilt: sine of the tilt of its scales.
PHYS HairLobes hair_lobes(Material m, Vec3 wo) {
  const float sin_o = wo.x;
  const float cos_o = square_root(wo.y * wo.y + wo.z * wo.z);
  // The ray inside: refracted with the index that the cylinder has in its cross section.
  const float inner2 = (m.ior * m.ior - 1.0f) + cos_o * cos_o;  // ior^2 - sin^2
  const float inner = square_root(inner2);
  const float sin_t = clamp_to(wo.y / inner, -1.0f, 1.0f);
  const float cos_t = safe_sqrt(1.0f - sin_t * sin_t);
  const float path = 2.0f * cos_t * m.ior / inner;
  const Vec3 t = vec3(exp_of(-m.transmittance.x * path), exp_of(-m.transmittance.y * path),
                      exp_of(-m.transmittance.z * path));
  const Refraction fresnel = fresnel_dielectric(min_of(wo.z, 1.0f), m.ior);
  const float azimuth_t = atan2_turns(sin_t, cos_t);
  const float variance = hair_variance(m.roughness);

  HairLobes l;
  l.azimuth_o = atan2_turns(wo.y, wo.z);
  l.scale = hair_logistic_scale(m.alpha);
  float sum = 0.0f;
  for (UNI int32 p = 0; p < PHALANX_HAIR_LOBES; p++) {
    l.attenuation[p] = hair_attenuation(p, fresnel.reflectance, t);
    l.share[p] = luminance(l.attenuation[p]);
    sum = sum + l.share[p];
    const Vec2 o = tilted_against_scales(p, m.tilt, sin_o, cos_o);
    l.sin_o[p] = o.x;
    l.cos_o[p] = o.y;
    l.variance[p] = p == 0 ? variance : (p == 1 ? 0.25f * variance : 4.0f * variance);
    l.azimuth[p] = (2.0f * to_float(p)) * azimuth_t - 2.0f * l.azimuth_o + 0.5f * to_float(p);
  }
  const float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
  for (UNI int32 p = 0; p < PHALANX_HAIR_LOBES; p++) l.share[p] = l.share[p] * scale;
  return l;
}

/// e^-x I0(x), x >= 0: modified Bessel function, relative error below 4e-7. Abramowitz and Stegun, 9.8.1, 9.8.2.
PHYS float scaled_bessel_i0(float x) {
  if (x < 3.75f) {
    const float t = (x / 3.75f) * (x / 3.75f);
    float p = 0.0045813f;
    p = p * t + 0.0360768f;
    p = p * t + 0.2659732f;
    p = p * t + 1.2067492f;
    p = p * t + 3.0899424f;
    p = p * t + 3.5156229f;
    return (p * t + 1.0f) * exp_of(-x);
  }
  const float t = 3.75f / x;
  float p = 0.00392377f;
  p = p * t - 0.01647633f;
  p = p * t + 0.02635537f;
  p = p * t - 0.02057706f;
  p = p * t + 0.00916281f;
  p = p * t - 0.00157565f;
  p = p * t + 0.00225319f;
  p = p * t + 0.01328592f;
  return (p * t + 0.39894228f) / square_root(x);
}

/// M_p, normalised over cos_i d(theta_i): d'Eon et al. 2011, eq. 7, with the exponentials gathered into
/// one that neither overflows nor cancels.
PHYS float hair_longitudinal(float sin_i, float cos_i, float sin_o, float cos_o, float variance) {
  const float x = 1.0f / variance;
  const float sum = sin_i + sin_o;
  const float off = cos_i - cos_o;
  const float distance = 0.5f * (sum * sum + off * off);  // 1 - cos of the angle to the lobe's axis
  return scaled_bessel_i0(cos_i * cos_o * x) * exp_of(-distance * x) *
         (x / one_minus_exp(2.0f * x));
}

/// Logistic distribution of `turns`, wrapped to [-0.5, 0.5] and cut there; per radian.
PHYS float hair_azimuthal(float turns, float scale) {
  const float x = abs_of(turns - round_down(turns + 0.5f));
  const float e = exp_of(-x / scale);
  const float cut = exp_of(-0.5f / scale);
  const float kept = (1.0f - cut) / (1.0f + cut);
  return 0.159154943091895f * e / (scale * (1.0f + e) * (1.0f + e) * kept);
}

/// Draws from hair_azimuthal, in turns around 0.
PHYS float sample_hair_azimuthal(float u, float scale) {
  const float cut = exp_of(-0.5f / scale);
  const float below = cut / (1.0f + cut);
  const float at = max_of(below + u * ((1.0f - cut) / (1.0f + cut)), 1e-9f);
  return clamp_to(scale * log_of(at / max_of(1.0f - at, 1e-9f)), -0.5f, 0.5f);
}

/// `turns`: azimuth of wi against wo.
PHYS BsdfValue hair_value(HairLobes l, float sin_i, float cos_i, float turns) {
  BsdfValue v = no_value();
  for (UNI int32 p = 0; p < PHALANX_HAIR_LOBES; p++) {
    float density = hair_longitudinal(sin_i, cos_i, l.sin_o[p], l.cos_o[p], l.variance[p]);
    // The last lobe stands for all longer ways through the hair: they leave evenly around it.
    if (p < PHALANX_HAIR_LOBES - 1)
      density = density * hair_azimuthal(turns - l.azimuth[p], l.scale);
    else
      density = density * 0.159154943091895f;
    v.f_cos = v.f_cos + l.attenuation[p] * density;
    v.pdf = v.pdf + l.share[p] * density;
  }
  if (!(v.pdf > 0.0f)) return no_value();
  return v;
}

/// sin(theta_i) and cos(theta_i) drawn from hair_longitudinal: directions on the sphere around the lobe's
/// axis with density exp(cos / variance) (d'Eon et al. 2013).
PHYS Vec2 sample_hair_longitudinal(float sin_o, float cos_o, float variance, float u,
                                   float u_turn) {
  const float left = exp_of(-2.0f / variance);
  const float below = 1.0f - u;  // in (0, 1]
  const float w =
      min_of(-variance * log_of(below + u * left), 2.0f);  // 1 - cos of the angle to the axis
  const float c = 1.0f - w;
  const float s = safe_sqrt(w * (2.0f - w));
  const SinCos turn = sincos_turns(u_turn);
  const float across = s * turn.sine;
  const float upright = c * cos_o + s * turn.cosine * sin_o;
  return vec2(s * turn.cosine * cos_o - c * sin_o,
              square_root(upright * upright + across * across));
}

PHYS BsdfSample sample_hair(Material m, Vec3 wo, Vec2 u, float u_lobe) {
  const HairLobes l = hair_lobes(m, wo);
  // A lobe by its share, and what is left of u_lobe.
  float rest = u_lobe;
  float share = l.share[0];
  float sin_o = l.sin_o[0];
  float cos_o = l.cos_o[0];
  float variance = l.variance[0];
  float azimuth = l.azimuth[0];
  bool even = false;
  for (UNI int32 p = 1; p < PHALANX_HAIR_LOBES; p++) {
    if (rest >= share && l.share[p] > 0.0f) {
      rest = rest - share;
      share = l.share[p];
      sin_o = l.sin_o[p];
      cos_o = l.cos_o[p];
      variance = l.variance[p];
      azimuth = l.azimuth[p];
      even = p == PHALANX_HAIR_LOBES - 1;
    }
  }
  const float u_turn = share > 0.0f ? min_of(rest / share, 1.0f) : 0.0f;
  const Vec2 theta = sample_hair_longitudinal(sin_o, cos_o, variance, u.x, u_turn);
  const float turns = even ? u.y : azimuth + sample_hair_azimuthal(u.y, l.scale);
  const float azimuth_i = l.azimuth_o + turns;
  const SinCos sc = sincos_turns(azimuth_i - round_down(azimuth_i));
  const BsdfValue v = hair_value(l, theta.x, theta.y, turns);
  BsdfSample s;
  s.wi = normalize(vec3(theta.x, theta.y * sc.sine, theta.y * sc.cosine));
  if (!(v.pdf > 0.0f) || s.wi.z == 0.0f) return no_sample();
  s.pdf = v.pdf;
  s.weight = v.f_cos * (1.0f / v.pdf);
  if (!is_finite(s.pdf) || !all_finite(s.weight)) return no_sample();
  return s;
}

PHYS BsdfValue eval_hair(Material m, Vec3 wo, Vec3 wi) {
  const HairLobes l = hair_lobes(m, wo);
  const float cos_i = square_root(wi.y * wi.y + wi.z * wi.z);
  return hair_value(l, wi.x, cos_i, atan2_turns(wi.y, wi.z) - l.azimuth_o);
}

PHALANX_END
