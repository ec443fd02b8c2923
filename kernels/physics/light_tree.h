// The tree of lights: choosing among many by what each may contribute to a point.
//
// Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting" (HPG 2018),
// without the receiver's normal: so the probability of a light is a function of the point alone, and light
// that is met by chance can be weighted against it.
#pragma once
#include "../scene_view.h"

PHALANX_BEGIN

struct Angle {
  float sine, cosine;  // of an angle in [0, pi]
};

PHYS Angle angle_of_cosine(float cosine) {
  Angle a;
  a.cosine = cosine;
  a.sine = safe_sqrt(1.0f - cosine * cosine);
  return a;
}

/// a - b, or 0 where b is larger.
PHYS Angle angle_beyond(Angle a, Angle b) {
  Angle r;
  r.cosine = 1.0f;
  r.sine = 0.0f;
  if (a.cosine > b.cosine) return r;
  r.cosine = a.cosine * b.cosine + a.sine * b.sine;
  r.sine = a.sine * b.cosine - a.cosine * b.sine;
  return r;
}

/// What may leave a node for a point, but for the distance: power times cosine. Zero only where no light of
/// the node can shine: the angles are bounds, and there is a margin for their rounding. Within the box's
/// sphere and at grazing angles it is kept away from 0.
PHYS float node_power(LightNode node, Vec3 origin) {
  const Vec3 from_center = origin - (node.lo + node.hi) * 0.5f;
  const float radius2 = length_squared((node.hi - node.lo) * 0.5f);
  const float distance2 = length_squared(from_center);
  if (!(distance2 > radius2)) return node.power;
  const float cos_w = dot(node.axis, from_center) / square_root(distance2);
  const float sin2_b = radius2 / distance2;
  Angle b;  // half the angle that the box's sphere fills
  b.sine = square_root(sin2_b);
  b.cosine = square_root(1.0f - sin2_b);
  const Angle w = angle_of_cosine(clamp_to(cos_w, -1.0f, 1.0f));
  const Angle least = angle_beyond(angle_beyond(w, angle_of_cosine(node.cos_o)), b);
  if (least.cosine < node.cos_e - 1.0e-3f) return 0.0f;
  return node.power * max_of(least.cosine, 0.01f);
}

/// Squared distances to the nearest and to the farthest point of a node's box.
PHYS float nearest_squared(LightNode node, Vec3 origin) {
  return length_squared(
      max3(max3(node.lo - origin, origin - node.hi), vec3(0.0f, 0.0f, 0.0f)));
}
PHYS float farthest_squared(LightNode node, Vec3 origin) {
  return length_squared(max3(abs3(node.lo - origin), abs3(node.hi - origin)));
}

/// The share of a in a / da + b / db, for distances that may be 0; a / (a + b) where both are.
PHYS float share_by_distance(float a, float da, float b, float db) {
  const float farther = max_of(da, db);
  if (!(farther > 0.0f)) return a / (a + b);
  const float wa = a * (db / farther);
  const float wb = b * (da / farther);
  return wa / (wa + wb);
}

/// Probability of going to the first of the two nodes from `first` on: the mean of what the nearest and the
/// farthest points of the boxes say (Yuksel, "Stochastic Lightcuts for Sampling Many Lights", TVCG 2020).
/// A distance to the centre alone misjudges boxes that are near or around the point: the variance in a town
/// of 600 lanterns was 3 to 10 times as large.
PHYS float first_probability(const UNI SceneView &scene, int32 first, Vec3 origin) {
  const LightNode a = fetch(scene.light_nodes, first);
  const LightNode b = fetch(scene.light_nodes, first + 1);
  float pa = node_power(a, origin);
  float pb = node_power(b, origin);
  if (!(pa + pb > 0.0f)) {  // nothing shines here: any choice will do
    pa = a.power;
    pb = b.power;
  }
  const float far = share_by_distance(pa, max_of(farthest_squared(a, origin), 1.0e-37f), pb,
                                      max_of(farthest_squared(b, origin), 1.0e-37f));
  if (!(pa > 0.0f) || !(pb > 0.0f)) return far;
  return 0.5f * (far + share_by_distance(pa, nearest_squared(a, origin), pb, nearest_squared(b, origin)));
}

struct ChosenLight {
  int32 light;
  float pdf;
};

#define PHALANX_LIGHT_TREE_DEPTH 31  // turns at most: bits of Light::path

/// A light for `origin`. A path of many turns needs more bits than a float has: u.y continues u.x.
PHYS ChosenLight choose_in_tree(const UNI SceneView &scene, Vec3 origin, float u, float more_bits) {
  double x = (double)u + (double)more_bits * (double)5.9604644775390625e-8f;
  ChosenLight c;
  c.pdf = 1.0f;
  int32 first = scene.light_nodes[0].first;
  for (UNI int32 level = 0; level < PHALANX_LIGHT_TREE_DEPTH; level++) {
    if (first >= 0) {
      const float p = first_probability(scene, first, origin);
      const double share = (double)p;
      const bool right = x >= share;
      if (right) {
        x = (x - share) / ((double)1.0f - share);
        c.pdf = c.pdf * (1.0f - p);
      } else {
        x = x / share;
        c.pdf = c.pdf * p;
      }
      x = x < (double)0.99999994f ? x : (double)0.99999994f;
      first = scene.light_nodes[first + (right ? 1 : 0)].first;
    }
  }
  c.light = -1 - first;
  return c;
}

/// Probability of choose_in_tree() returning a light at the end of this path (Light::path).
PHYS float tree_pdf(const UNI SceneView &scene, int32 path, int32 depth, Vec3 origin) {
  float pdf = 1.0f;
  int32 first = scene.light_nodes[0].first;
  for (UNI int32 level = 0; level < PHALANX_LIGHT_TREE_DEPTH; level++) {
    if (level < depth) {
      const int32 turn = (path >> level) & 1;
      const float p = first_probability(scene, first, origin);
      pdf = pdf * (turn != 0 ? 1.0f - p : p);
      first = scene.light_nodes[first + turn].first;
    }
  }
  return pdf;
}

PHALANX_END
