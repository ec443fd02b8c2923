// Motion blur: when a path looks at the scene, and where moving instances are then.
//
// Embree interpolates transforms itself, but rounds otherwise in packets than in single rays. So moving
// instances are user geometry of Embree that asks instance_at(), and shading asks it again.
#pragma once
#include "../scene_view.h"
#include "sampler_sobol.h"

PHALANX_BEGIN

/// Time of a sample of a pixel, in [0, 1), stratified over the samples; the same along its whole path.
/// scramble: pixel_scramble(). 0 in scenes without motion.
PHYS float path_time(const UNI SceneView &scene, int32 scramble, int32 sample) {
  if (scene.has_motion == 0) return 0.0f;
  const Vec2 u = sobol_pair(hash32((uint32)scramble + 0x7f4a7c15u), sample);
  return u.x;
}

PHYS float mix_entry(float a, float b, float t) { return a * (1.0f - t) + b * t; }

/// Entry by entry.
PHYS Affine mix_affine(Affine a, Affine b, float t) {
  Affine r;
  r.m00 = mix_entry(a.m00, b.m00, t);
  r.m01 = mix_entry(a.m01, b.m01, t);
  r.m02 = mix_entry(a.m02, b.m02, t);
  r.m03 = mix_entry(a.m03, b.m03, t);
  r.m10 = mix_entry(a.m10, b.m10, t);
  r.m11 = mix_entry(a.m11, b.m11, t);
  r.m12 = mix_entry(a.m12, b.m12, t);
  r.m13 = mix_entry(a.m13, b.m13, t);
  r.m20 = mix_entry(a.m20, b.m20, t);
  r.m21 = mix_entry(a.m21, b.m21, t);
  r.m22 = mix_entry(a.m22, b.m22, t);
  r.m23 = mix_entry(a.m23, b.m23, t);
  return r;
}

/// Inverse by cofactors; the builder refuses motions that come near to a singular map.
PHYS Affine inverse_affine(Affine a) {
  const Vec3 x = vec3(a.m00, a.m10, a.m20);
  const Vec3 y = vec3(a.m01, a.m11, a.m21);
  const Vec3 z = vec3(a.m02, a.m12, a.m22);
  const float scale = 1.0f / dot(x, cross(y, z));
  const Vec3 p = cross(y, z) * scale;
  const Vec3 q = cross(z, x) * scale;
  const Vec3 r = cross(x, y) * scale;
  const Vec3 shift = vec3(a.m03, a.m13, a.m23);
  Affine i;
  i.m00 = p.x;
  i.m01 = p.y;
  i.m02 = p.z;
  i.m03 = -dot(p, shift);
  i.m10 = q.x;
  i.m11 = q.y;
  i.m12 = q.z;
  i.m13 = -dot(q, shift);
  i.m20 = r.x;
  i.m21 = r.y;
  i.m22 = r.z;
  i.m23 = -dot(r, shift);
  return i;
}

/// Instance `index` at a time in [0, 1].
PHYS Instance instance_at(const UNI SceneView &scene, int32 index, float time) {
  Instance i = fetch(scene.instances, index);
  if (scene.has_motion != 0) {
    const Motion m = fetch(scene.motions, index);
    if (m.moves != 0) {
      i.to_world = mix_affine(i.to_world, m.to_world_end, time);
      i.to_object = inverse_affine(i.to_world);
    }
  }
  return i;
}

PHALANX_END
