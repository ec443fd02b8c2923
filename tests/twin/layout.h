// Fields of the structs that host and kernels share: the same list for C++ and ISPC.
//
// F(type, field) per field, S(type) per struct. A new field needs one entry here.
#pragma once

#define LAYOUT_LIST(F, S)                                                                       \
  F(Material, kind) F(Material, reflectance) F(Material, eta) F(Material, k)                    \
  F(Material, has_ior) F(Material, alpha) F(Material, ior) F(Material, emission)                \
  F(Material, two_sided) S(Material)                                                            \
  F(Geometry, shape) F(Geometry, material) F(Geometry, kind) F(Geometry, first) F(Geometry, first_light)          \
  F(Geometry, normal_offset) F(Geometry, has_normals) S(Geometry)                               \
  F(Triangle, v0) F(Triangle, v1) F(Triangle, v2) S(Triangle)                                   \
  F(Quad, corner) F(Quad, edge_u) F(Quad, edge_v) S(Quad)                                       \
  F(Sphere, center) F(Sphere, radius) S(Sphere)                                                 \
  F(Disk, center) F(Disk, axis_u) F(Disk, axis_v) S(Disk)                                       \
  F(Instance, first_geometry) F(Instance, to_world) F(Instance, to_object) S(Instance)          \
  F(Affine, m00) F(Affine, m03) F(Affine, m10) F(Affine, m23) S(Affine)                         \
  F(Light, kind) F(Light, two_sided) F(Light, p) F(Light, a) F(Light, b) F(Light, normal)       \
  F(Light, radius) F(Light, area) F(Light, select_pdf) F(Light, error) F(Light, emission)       \
  S(Light)                                                                                      \
  F(SceneView, accel) F(SceneView, materials) F(SceneView, geometries) F(SceneView, positions)  \
  F(SceneView, vertex_normals) F(SceneView, triangles) F(SceneView, quads)                      \
  F(SceneView, spheres) F(SceneView, disks) F(SceneView, instances) F(SceneView, lights)        \
  F(SceneView, alias_threshold) F(SceneView, alias_other) F(SceneView, num_materials)           \
  F(SceneView, num_geometries) F(SceneView, num_lights) F(SceneView, num_instances)             \
  F(SceneView, num_spheres) F(SceneView, num_top_geometries) F(SceneView, has_environment)      \
  F(SceneView, environment) S(SceneView)                                                        \
  F(Camera, position) F(Camera, right) F(Camera, up) F(Camera, forward)                         \
  F(Camera, tan_half_fov_y) F(Camera, lens_radius) F(Camera, focus_distance) S(Camera)          \
  F(FrameView, camera) F(FrameView, width) F(FrameView, height) F(FrameView, filter_offsets)    \
  F(FrameView, sampler) F(FrameView, seed) F(FrameView, max_depth)                              \
  F(FrameView, roulette_depth) S(FrameView)                                                     \
  F(WaveView, capacity) F(WaveView, origin_x) F(WaveView, origin_y) F(WaveView, origin_z)       \
  F(WaveView, direction_x) F(WaveView, direction_y) F(WaveView, direction_z)                    \
  F(WaveView, throughput_r) F(WaveView, throughput_g) F(WaveView, throughput_b)                 \
  F(WaveView, pdf) F(WaveView, depth) F(WaveView, scramble) F(WaveView, block_index)            \
  F(WaveView, hit_geometry) F(WaveView, hit_primitive) F(WaveView, hit_kind)                    \
  F(WaveView, hit_instance)                                                                     \
  F(WaveView, hit_far_root) F(WaveView, shadow_origin_x) F(WaveView, shadow_origin_y)           \
  F(WaveView, shadow_origin_z) F(WaveView, shadow_direction_x)                                  \
  F(WaveView, shadow_direction_y) F(WaveView, shadow_direction_z)                               \
  F(WaveView, shadow_distance) F(WaveView, shadow_r) F(WaveView, shadow_g)                      \
  F(WaveView, shadow_b) F(WaveView, active) F(WaveView, free) F(WaveView, order)                \
  F(WaveView, shadow_list) S(WaveView)                                                          \
  F(TileView, pixels) F(TileView, num_pixels) F(TileView, log2_samples)                         \
  F(TileView, first_sample) F(TileView, num_samples) F(TileView, radiance) F(TileView, aov)     \
  S(TileView)

#define LAYOUT_MAX 256  // numbers
