// Stage 2: closest hits, a gang of rays at a time.
#include "gang.isph"
#include "trace.isph"

export void KERNEL(intersect)(const uniform SceneView &scene, const uniform TileView &tile,
                              const uniform WaveView &wave, const uniform int32 slots[],
                              uniform int32 count, uniform int32 order) {
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    const Hit hit =
        trace_closest(scene, get3(wave.origin_x, wave.origin_y, wave.origin_z, g),
                      get3(wave.direction_x, wave.direction_y, wave.direction_z, g),
                      get_time(scene, tile, wave, g), order);
    put(wave.hit_geometry, g, hit.geometry);
    put(wave.hit_primitive, g, hit.primitive);
    int32 kind = kEscaped;
    if (hit.geometry >= 0) {
      const Geometry geometry = fetch(scene.geometries, hit.geometry);
      kind = geometry.kind;
    }
    put(wave.hit_kind, g, kind);
    if (scene.num_spheres > 0) put(wave.hit_far_root, g, hit.far_root);
    if (scene.num_instances > 0) put(wave.hit_instance, g, hit.instance);
    if (scene.num_curve_segments > 0) put(wave.hit_u, g, hit.u);
  }
}
