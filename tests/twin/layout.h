// Fields of the structs that host and kernels share: the same list for C++ and ISPC.
//
// F(type, field) per field, S(type) per struct. A new field needs one entry here.
#pragma once

#define LAYOUT_LIST(F, S)                                                                         \
  F(Affine, m00) F(Affine, m01) F(Affine, m02) F(Affine, m03) F(Affine, m10) F(Affine, m11)       \
  F(Affine, m12) F(Affine, m13) F(Affine, m20) F(Affine, m21) F(Affine, m22) F(Affine, m23)       \
  S(Affine) F(Material, kind) F(Material, reflectance) F(Material, eta) F(Material, k)            \
  F(Material, has_ior) F(Material, alpha) F(Material, ior) F(Material, emission)                  \
  F(Material, two_sided) F(Material, one_sided) F(Material, specular)                             \
  F(Material, transmittance) F(Material, alpha_x) F(Material, alpha_y) F(Material, roughness)     \
  F(Material, exponent) F(Material, tilt) F(Material, compensate) F(Material, table)              \
  F(Material, metallic) F(Material, transmission) F(Material, specular_level)                     \
  F(Material, clearcoat) F(Material, clearcoat_alpha) F(Material, sheen_alpha)                    \
  F(Material, sheen) F(Material, blend_a) F(Material, blend_b) F(Material, weight)                \
  F(Material, opacity) F(Material, bump_scale) F(Material, normal_scale) F(Material, textured)    \
  F(Material, reflectance_texture) F(Material, specular_texture)                                  \
  F(Material, transmittance_texture) F(Material, roughness_texture)                               \
  F(Material, metallic_texture) F(Material, transmission_texture)                                 \
  F(Material, clearcoat_texture) F(Material, sheen_texture) F(Material, emission_texture)         \
  F(Material, weight_texture) F(Material, opacity_texture) F(Material, normal_texture)            \
  F(Material, bump_texture) S(Material) F(Texture, kind) F(Texture, channel) F(Texture, a)        \
  F(Texture, b) F(Texture, m00) F(Texture, m01) F(Texture, m02) F(Texture, m10) F(Texture, m11)   \
  F(Texture, m12) F(Texture, format) F(Texture, first) F(Texture, width) F(Texture, height)       \
  F(Texture, wrap_u) F(Texture, wrap_v) F(Texture, nearest) F(Texture, srgb) F(Texture, scale)    \
  F(Texture, turbulence) F(Texture, octaves) S(Texture) F(Geometry, shape)                        \
  F(Geometry, material) F(Geometry, kind) F(Geometry, first) F(Geometry, first_light)             \
  F(Geometry, normal_offset) F(Geometry, has_normals) F(Geometry, uv_offset)                      \
  F(Geometry, has_uvs) F(Geometry, colour_offset) F(Geometry, has_colours) S(Geometry)            \
  F(Triangle, v0) F(Triangle, v1) F(Triangle, v2) S(Triangle) F(Quad, corner) F(Quad, edge_u)     \
  F(Quad, edge_v) S(Quad) F(Sphere, center) F(Sphere, radius) S(Sphere) F(Disk, center)           \
  F(Disk, axis_u) F(Disk, axis_v) S(Disk) F(Instance, first_geometry) F(Instance, to_world)       \
  F(Instance, to_object) S(Instance) F(Motion, moves) F(Motion, to_world_end) S(Motion)           \
  F(Light, kind) F(Light, two_sided) F(Light, p) F(Light, a) F(Light, b) F(Light, normal)         \
  F(Light, radius) F(Light, area) F(Light, select_pdf) F(Light, error) F(Light, emission)         \
  F(Light, emission_texture) F(Light, opacity_texture) F(Light, uv) F(Light, uv_a)                \
  F(Light, uv_b) F(Light, colour) F(Light, colour_a) F(Light, colour_b)                           \
  F(Light, by_solid_angle) F(Light, cos_inner) F(Light, cos_outer) F(Light, profile)              \
  F(Light, one_minus_cos) F(Light, path) F(Light, path_depth) S(Light) F(LightNode, lo)           \
  F(LightNode, hi) F(LightNode, axis) F(LightNode, cos_o) F(LightNode, cos_e)                     \
  F(LightNode, power) F(LightNode, first) S(LightNode) F(LightProfile, first)                     \
  F(LightProfile, num_vertical) F(LightProfile, num_horizontal) F(LightProfile, s)                \
  F(LightProfile, t) F(LightProfile, n) S(LightProfile) F(SceneView, accel)                       \
  F(SceneView, materials) F(SceneView, geometries) F(SceneView, positions)                        \
  F(SceneView, vertex_normals) F(SceneView, triangles) F(SceneView, quads)                        \
  F(SceneView, spheres) F(SceneView, disks) F(SceneView, instances) F(SceneView, lights)          \
  F(SceneView, alias_threshold) F(SceneView, alias_other) F(SceneView, num_materials)             \
  F(SceneView, num_geometries) F(SceneView, num_lights) F(SceneView, num_instances)               \
  F(SceneView, num_spheres) F(SceneView, num_top_geometries) F(SceneView, has_environment)        \
  F(SceneView, environment) F(SceneView, textures) F(SceneView, byte_texels)                      \
  F(SceneView, float_texels) F(SceneView, decode) F(SceneView, vertex_uvs)                        \
  F(SceneView, vertex_colours) F(SceneView, tables) F(SceneView, profiles)                        \
  F(SceneView, light_nodes) F(SceneView, curve_points) F(SceneView, curve_along)                  \
  F(SceneView, curve_segments) F(SceneView, num_curve_segments) F(SceneView, motions)             \
  F(SceneView, has_motion) F(SceneView, num_textures) F(SceneView, num_light_nodes)               \
  F(SceneView, num_infinite_lights) F(SceneView, infinite_share) F(SceneView, has_blends)         \
  F(SceneView, has_opacity) F(SceneView, environment_texels) F(SceneView, environment_rows)       \
  F(SceneView, environment_columns) F(SceneView, environment_width)                               \
  F(SceneView, environment_height) F(SceneView, environment_x) F(SceneView, environment_y)        \
  F(SceneView, environment_z) S(SceneView) F(Camera, position) F(Camera, right) F(Camera, up)     \
  F(Camera, forward) F(Camera, tan_half_fov_y) F(Camera, lens_radius) F(Camera, focus_distance)   \
  F(Camera, kind) F(Camera, half_height) F(Camera, half_angle_turns) F(Camera, blades)            \
  F(Camera, blade_turns) S(Camera) F(FrameView, camera) F(FrameView, width)                       \
  F(FrameView, height) F(FrameView, filter_offsets) F(FrameView, sampler) F(FrameView, seed)      \
  F(FrameView, max_depth) F(FrameView, roulette_depth) F(FrameView, integrator)                   \
  F(FrameView, occlusion_distance) F(FrameView, spp) F(FrameView, bounce_order) S(FrameView) F(WaveView, capacity)           \
  F(WaveView, origin_x) F(WaveView, origin_y) F(WaveView, origin_z) F(WaveView, direction_x)      \
  F(WaveView, direction_y) F(WaveView, direction_z) F(WaveView, throughput_r)                     \
  F(WaveView, throughput_g) F(WaveView, throughput_b) F(WaveView, pdf) F(WaveView, depth)         \
  F(WaveView, scramble) F(WaveView, block_index) F(WaveView, hit_geometry)                        \
  F(WaveView, hit_primitive) F(WaveView, hit_kind) F(WaveView, hit_instance)                      \
  F(WaveView, hit_far_root) F(WaveView, hit_material) F(WaveView, hit_u)                          \
  F(WaveView, shadow_origin_x) F(WaveView, shadow_origin_y) F(WaveView, shadow_origin_z)          \
  F(WaveView, shadow_direction_x) F(WaveView, shadow_direction_y)                                 \
  F(WaveView, shadow_direction_z) F(WaveView, shadow_distance) F(WaveView, shadow_r)              \
  F(WaveView, shadow_g) F(WaveView, shadow_b) F(WaveView, active) F(WaveView, free)               \
  F(WaveView, order) F(WaveView, shadow_list) S(WaveView) F(TileView, pixels)                     \
  F(TileView, num_pixels) F(TileView, log2_samples) F(TileView, first_sample)                     \
  F(TileView, num_samples) F(TileView, radiance) F(TileView, aov) S(TileView)

#define LAYOUT_MAX 512  // numbers
