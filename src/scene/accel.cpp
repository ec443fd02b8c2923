// What the host knows of Embree, with inner_scene.cpp: building, and queries of one ray.
//
// Meshes and quads are Embree's own geometries (ROBUST, so that nothing leaks at edges). Spheres and
// disks are user geometry whose intersection is ours (kernels/physics/shape.h): Embree's packets
// and single rays differ in the last bits for them, and ours is the one that shading repeats.
#include "accel.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <tuple>

#include "../../kernels/embree_version.h"
#include "../../kernels/physics/opacity.h"
#include "../../kernels/physics/shape.h"
#include "../core/error.h"
#include "inner_scene.h"
#include "trace.h"

namespace phalanx {
namespace {

/// Embree's name for an instruction set: its kernels are pinned to the same one as ours.
const char *embree_isa(const std::string &isa) {
  if (isa == "avx512skx") return "avx512";
  if (isa == "avx2") return "avx2";
  return "sse4.2";
}

struct ErrorRecord {
  std::atomic<bool> out_of_memory = false;
  std::string text;
};

void on_error(void *user, RTCError code, const char *text) {
  auto *record = static_cast<ErrorRecord *>(user);
  if (code == RTC_ERROR_OUT_OF_MEMORY) record->out_of_memory = true;
  if (record->text.empty()) record->text = text ? text : "unknown error";
}

bool on_memory(void *user, ssize_t bytes, bool) {
  *static_cast<std::atomic<std::int64_t> *>(user) += bytes;
  return true;
}

// ---- ties -------------------------------------------------------------------------------------

struct Ids {
  unsigned geometry, primitive, instance;
  bool operator<(const Ids &o) const {
    return std::tie(instance, geometry, primitive) < std::tie(o.instance, o.geometry, o.primitive);
  }
};

/// A query that keeps the nearest hit and, of several at its distance, the lowest ids.
struct TieContext {
  PhalanxQueryContext embree;  // first: Embree hands out a pointer to it
  float t;
  Ids ids;
};

void collect(PhalanxQueryContext *context, float t, Ids ids) {
  auto *tie = reinterpret_cast<TieContext *>(context);
  if (t > tie->t || (t == tie->t && !(ids < tie->ids))) return;
  tie->t = t;
  tie->ids = ids;
}

void collect_all(const RTCFilterFunctionNArguments *args) {
  if (args->valid[0] != -1) return;
  collect(args->context, RTCRayN_tfar(args->ray, 1, 0),
          {RTCHitN_geomID(args->hit, 1, 0), RTCHitN_primID(args->hit, 1, 0),
           RTCHitN_instID(args->hit, 1, 0, 0)});
  args->valid[0] = 0;  // go on looking
}

struct RayRead {
  Vec3 origin, direction;
  unsigned id;  // ray_id()
};
[[gnu::always_inline]] inline RayRead read_ray(RTCRayN *ray, unsigned n, unsigned i) {
  return {{RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i), RTCRayN_org_z(ray, n, i)},
          {RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i), RTCRayN_dir_z(ray, n, i)},
          RTCRayN_id(ray, n, i)};
}

// ---- opacity ----------------------------------------------------------------------------------

/// A geometry whose material may let rays through.
struct Holes {
  const SceneView *scene = nullptr;
  int32 geometry = 0;  // record
  float metres = 1;    // a unit of the geometry's Embree scene

  bool let_pass(const RayRead &ray, unsigned primitive, int32 far_root, float u = 0) const {
    Hit hit = {};
    hit.u = u;
    hit.geometry = geometry;
    hit.primitive = static_cast<int32>(primitive);
    hit.far_root = far_root;
    return passes_through(*scene, hit, ray.origin * metres, ray.direction * metres, ray.id);
  }
};

void filter_holes(const RTCFilterFunctionNArguments *args) {
  const auto *holes = static_cast<const Holes *>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const RayRead ray = read_ray(args->ray, args->N, i);
    if (holes->let_pass(ray, RTCHitN_primID(args->hit, args->N, i), 0)) args->valid[i] = 0;
  }
}

void filter_curve_holes(const RTCFilterFunctionNArguments *args) {
  const auto *holes = static_cast<const Holes *>(args->geometryUserPtr);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] != -1) continue;
    const RayRead ray = read_ray(args->ray, n, i);
    const Vec3 normal = {RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i),
                         RTCHitN_Ng_z(args->hit, n, i)};
    const float u = curve_hit_u(*holes->scene, -1, 0, RTCHitN_u(args->hit, n, i), normal, ray.direction);
    if (holes->let_pass(ray, RTCHitN_primID(args->hit, n, i), bits_from_float(u) < 0 ? 1 : 0, u))
      args->valid[i] = 0;
  }
}

// ---- spheres and disks ------------------------------------------------------------------------

/// What the callbacks of one geometry need.
struct AnalyticShapes {
  const Sphere *spheres = nullptr;  // one of the two
  const Disk *disks = nullptr;
  Holes holes;                      // holes.scene is null where there are none

  ShapeHit intersect(unsigned id, const RayRead &ray, float t_min, float t_max) const {
    const ShapeHit hit = nearest(id, ray, t_min, t_max);
    return holes.scene == nullptr ? hit : past_holes(hit, id, ray, t_max);
  }

 private:
  [[gnu::noinline]] ShapeHit past_holes(ShapeHit hit, unsigned id, const RayRead &ray,
                                        float t_max) const {
    while (hit.t >= 0 && holes.let_pass(ray, id, hit.far_root))
      hit = nearest(id, ray, std::nextafter(hit.t, PHALANX_FAR), t_max);
    return hit;
  }
  ShapeHit nearest(unsigned id, const RayRead &ray, float t_min, float t_max) const {
    if (spheres != nullptr)
      return intersect_sphere(ray.origin, ray.direction, spheres[id], t_min, t_max);
    return intersect_disk(ray.origin, ray.direction, disks[id], t_min, t_max);
  }
};

void analytic_bounds(const RTCBoundsFunctionArguments *args) {
  const auto *shapes = static_cast<const AnalyticShapes *>(args->geometryUserPtr);
  RTCBounds *b = args->bounds_o;
  Vec3 c, r;
  if (shapes->spheres != nullptr) {
    const Sphere s = shapes->spheres[args->primID];
    c = s.center;
    r = {s.radius, s.radius, s.radius};
  } else {
    // The box of a disk: half width sqrt(u^2 + v^2) along each axis.
    const Disk d = shapes->disks[args->primID];
    c = d.center;
    r = {square_root(d.axis_u.x * d.axis_u.x + d.axis_v.x * d.axis_v.x),
         square_root(d.axis_u.y * d.axis_u.y + d.axis_v.y * d.axis_v.y),
         square_root(d.axis_u.z * d.axis_u.z + d.axis_v.z * d.axis_v.z)};
  }
  // Wider by a few roundings, so that a hit never lies outside its box.
  const Vec3 slack = (abs3(c) + r) * 1e-6f;
  b->lower_x = c.x - r.x - slack.x;
  b->lower_y = c.y - r.y - slack.y;
  b->lower_z = c.z - r.z - slack.z;
  b->upper_x = c.x + r.x + slack.x;
  b->upper_y = c.y + r.y + slack.y;
  b->upper_z = c.z + r.z + slack.z;
}

void analytic_intersect(const RTCIntersectFunctionNArguments *args) {
  const auto *shapes = static_cast<const AnalyticShapes *>(args->geometryUserPtr);
  RTCRayN *ray = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN *hit = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const RayRead r = read_ray(ray, args->N, i);
    const ShapeHit found = shapes->intersect(args->primID, r, RTCRayN_tnear(ray, args->N, i),
                                             RTCRayN_tfar(ray, args->N, i));
    if (found.t < 0) continue;
    if (phalanx_collects(args->context)) {
      collect(args->context, found.t, {args->geomID, args->primID, args->context->instID[0]});
      continue;
    }
    RTCRayN_tfar(ray, args->N, i) = found.t;
    RTCHitN_u(hit, args->N, i) = found.far_root != 0 ? 0.5f : 0.25f;  // read as far_root
    RTCHitN_v(hit, args->N, i) = 0.25f;                               // and away from all edges
    RTCHitN_geomID(hit, args->N, i) = args->geomID;
    RTCHitN_primID(hit, args->N, i) = args->primID;
    RTCHitN_instID(hit, args->N, i, 0) = args->context->instID[0];
  }
}

void analytic_occluded(const RTCOccludedFunctionNArguments *args) {
  const auto *shapes = static_cast<const AnalyticShapes *>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const RayRead r = read_ray(args->ray, args->N, i);
    const ShapeHit found = shapes->intersect(args->primID, r, RTCRayN_tnear(args->ray, args->N, i),
                                             RTCRayN_tfar(args->ray, args->N, i));
    if (found.t >= 0) RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

// ---- building ---------------------------------------------------------------------------------

struct Accel::State {
  ErrorRecord error;
  std::atomic<std::int64_t> bytes = 0;
  RTCDevice device = nullptr;
  std::vector<RTCScene> scenes;  // all that are to be released
  std::vector<RTCScene> groups;
  RTCScene top = nullptr;
  std::vector<std::unique_ptr<AnalyticShapes>> analytic;
  SceneView view = {};           // for opacity and motion
  std::vector<std::unique_ptr<InnerScene>> inner;
  std::vector<std::unique_ptr<Holes>> holes;

  ~State() {
    for (RTCScene s : scenes) rtcReleaseScene(s);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void check() const {
    if (error.out_of_memory) throw MemoryError("Embree ran out of memory building the scene");
    if (!error.text.empty()) throw std::runtime_error("Embree: " + error.text);
  }

  RTCScene new_scene() {
    RTCScene s = rtcNewScene(device);
    scenes.push_back(s);
    rtcSetSceneFlags(s, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | PHALANX_FILTER_SCENE_FLAG));
    rtcSetSceneBuildQuality(s, RTC_BUILD_QUALITY_MEDIUM);
    return s;
  }

  void attach(RTCScene target, RTCGeometry geometry, unsigned id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(target, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  Holes holes_of(const Scene &scene, std::int32_t g) const {
    const Material &m = scene.materials[static_cast<size_t>(scene.geometries[g].material)];
    return {has_holes(m) ? &view : nullptr, g};
  }

  void add_holes(RTCGeometry geometry, const Scene &scene, std::int32_t g, float scale) {
    Holes found = holes_of(scene, g);
    found.metres = 1 / scale;
    if (found.scene == nullptr) return;
    holes.push_back(std::make_unique<Holes>(found));
    rtcSetGeometryUserData(geometry, holes.back().get());
    const bool curve = scene.geometries[g].shape == kCurves;
    rtcSetGeometryIntersectFilterFunction(geometry, curve ? filter_curve_holes : filter_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, curve ? filter_curve_holes : filter_holes);
  }

  RTCGeometry mesh(const Scene &scene, std::int32_t g) {
    RTCGeometry m = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(m, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               scene.positions.data(), 0, 3 * sizeof(float),
                               static_cast<size_t>(scene.num_vertices()));
    rtcSetSharedGeometryBuffer(m, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               scene.triangles.data() + scene.geometries[g].first, 0,
                               sizeof(Triangle), static_cast<size_t>(scene.num_prims[g]));
    return m;
  }

  RTCGeometry quads(const Scene &scene, std::int32_t g) {
    const auto n = static_cast<size_t>(scene.num_prims[g]);
    RTCGeometry m = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    auto *corner = static_cast<float *>(rtcSetNewGeometryBuffer(
        m, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * n));
    auto *index = static_cast<unsigned *>(rtcSetNewGeometryBuffer(
        m, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), n));
    if (corner == nullptr || index == nullptr) return m;
    for (size_t i = 0; i < n; ++i) {
      const Quad q = scene.quads[static_cast<size_t>(scene.geometries[g].first) + i];
      const Vec3 corners[] = {q.corner, q.corner + q.edge_u, q.corner + q.edge_u + q.edge_v,
                              q.corner + q.edge_v};
      for (size_t c = 0; c < 4; ++c) {
        corner[12 * i + 3 * c] = corners[c].x;
        corner[12 * i + 3 * c + 1] = corners[c].y;
        corner[12 * i + 3 * c + 2] = corners[c].z;
        index[4 * i + c] = static_cast<unsigned>(4 * i + c);
      }
    }
    return m;
  }

  /// The segments first[0 .. n-1] at the scale of an inner scene.
  RTCGeometry curves(const Scene &scene, const int32 *first, size_t n, float scale) {
    RTCGeometry c = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    const size_t first_point = static_cast<size_t>(first[0]);
    const size_t num_points = static_cast<size_t>(first[n - 1]) + 2 - first_point;
    auto *points = static_cast<float *>(rtcSetNewGeometryBuffer(
        c, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), num_points));
    auto *index = static_cast<unsigned *>(rtcSetNewGeometryBuffer(
        c, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), n));
    auto *flags = static_cast<unsigned char *>(
        rtcSetNewGeometryBuffer(c, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, n));
    if (points == nullptr || index == nullptr || flags == nullptr) return c;
    for (size_t i = 0; i < 4 * num_points; ++i)
      points[i] = scene.curve_points[4 * first_point + i] * scale;
    for (size_t i = 0; i < n; ++i) {
      index[i] = static_cast<unsigned>(first[i]) - static_cast<unsigned>(first_point);
      // Neighbours share a point.
      const bool left = i > 0 && first[i] == first[i - 1] + 1;
      const bool right = i + 1 < n && first[i + 1] == first[i] + 1;
      flags[i] = static_cast<unsigned char>((left ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                            (right ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
    }
    return c;
  }

  /// `id`: as which hits are reported, of the geometry around the strands, too.
  RTCGeometry strands(const Scene &scene, std::int32_t g, unsigned id) {
    const auto n = static_cast<size_t>(scene.num_prims[g]);
    const int32 *const first = scene.curve_segments.data() + scene.geometries[g].first;
    const float scale = strand_scale(scene, first, n);
    RTCGeometry c = curves(scene, first, n, scale);
    add_holes(c, scene, g, scale);
    RTCScene s = new_scene();
    attach(s, c, id);
    rtcCommitScene(s);
    return inner_geometry({s, nullptr, -1, scale});
  }

  RTCGeometry analytic_shapes(const Scene &scene, std::int32_t g) {
    const Geometry &record = scene.geometries[g];
    auto shapes = std::make_unique<AnalyticShapes>();
    if (record.shape == kSpheres) shapes->spheres = scene.spheres.data() + record.first;
    else shapes->disks = scene.disks.data() + record.first;
    shapes->holes = holes_of(scene, g);
    RTCGeometry u = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(u, static_cast<unsigned>(scene.num_prims[g]));
    rtcSetGeometryUserData(u, shapes.get());
    rtcSetGeometryBoundsFunction(u, analytic_bounds, nullptr);
    rtcSetGeometryIntersectFunction(u, analytic_intersect);
    rtcSetGeometryOccludedFunction(u, analytic_occluded);
    analytic.push_back(std::move(shapes));
    return u;
  }

  void attach_range(RTCScene target, const Scene &scene, GeometryRange range) {
    for (std::int32_t i = 0; i < range.count; ++i) {
      const std::int32_t g = range.first + i;
      const int shape = scene.geometries[g].shape;
      RTCGeometry geometry = shape == kMesh     ? mesh(scene, g)
                             : shape == kQuads  ? quads(scene, g)
                             : shape == kCurves ? strands(scene, g, static_cast<unsigned>(i))
                                                : analytic_shapes(scene, g);
      if (shape == kMesh || shape == kQuads) add_holes(geometry, scene, g, 1);
      attach(target, geometry, static_cast<unsigned>(i));
    }
  }

  RTCGeometry resting_instance(RTCScene group, const Instance &from) {
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, group);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, &from.to_world);
    return instance;
  }

  RTCGeometry inner_geometry(const InnerScene &from) {
    inner.push_back(std::make_unique<InnerScene>(from));
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    set_inner_scene(g, inner.back().get());
    return g;
  }

  void attach_instances(RTCScene top, const Scene &scene) {
    for (size_t i = 0; i < scene.instances.size(); ++i) {
      RTCScene group = groups[static_cast<size_t>(scene.instance_group[i])];
      const bool moves = !scene.motions.empty() && scene.motions[i].moves != 0;
      RTCGeometry instance =
          moves ? inner_geometry({group, &view, static_cast<int32>(i), 1}) : resting_instance(group, scene.instances[i]);
      attach(top, instance, static_cast<unsigned>(scene.top_level.count) + static_cast<unsigned>(i));
    }
  }
};

Accel::Accel(const Scene &scene, const std::string &isa, int threads)
    : state_(std::make_unique<State>()) {
  state_->view = scene.view();
  const std::string config = fmt::format("isa={},threads={}", embree_isa(isa), threads);
  state_->device = rtcNewDevice(config.c_str());
  if (state_->device == nullptr) throw std::runtime_error("Embree cannot start with " + config);
  rtcSetDeviceErrorFunction(state_->device, on_error, &state_->error);
  rtcSetDeviceMemoryMonitorFunction(state_->device, on_memory, &state_->bytes);
  for (const GeometryRange &group : scene.groups) {
    RTCScene s = state_->new_scene();
    state_->groups.push_back(s);
    state_->attach_range(s, scene, group);
    rtcCommitScene(s);
    state_->check();
  }
  RTCScene top = state_->top = state_->new_scene();
  state_->attach_range(top, scene, scene.top_level);
  state_->attach_instances(top, scene);
  rtcCommitScene(top);
  state_->check();
}

Accel::~Accel() = default;

void *Accel::handle() const { return state_->top; }

std::int64_t Accel::bytes() const { return state_->bytes; }

std::string Accel::library_version() { return "Embree " RTC_VERSION_STRING; }

// ---- queries of one ray -----------------------------------------------------------------------

namespace {
void set_ray(RTCRay &r, Vec3 origin, Vec3 direction, float t_far, float time, uint32 id) {
  r.org_x = origin.x;
  r.org_y = origin.y;
  r.org_z = origin.z;
  r.tnear = PHALANX_NEAR;
  r.dir_x = direction.x;
  r.dir_y = direction.y;
  r.dir_z = direction.z;
  r.time = time;
  r.tfar = t_far;
  r.mask = ~0u;
  r.id = id;
  r.flags = 0;
}
}  // namespace

extern "C" void phalanx_resolve_tie(void *accel, const float ray[7], float t, uint32 id,
                                    int32 ids[3]) {
  RTCRayHit r;
  // A little further than the hit, so that all that share its distance are met.
  const float t_far = t * 1.000001f;
  set_ray(r.ray, {ray[0], ray[1], ray[2]}, {ray[3], ray[4], ray[5]}, t_far, ray[6], id);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  TieContext tie;
  tie.t = t_far;
  tie.ids = {RTC_INVALID_GEOMETRY_ID, RTC_INVALID_GEOMETRY_ID, RTC_INVALID_GEOMETRY_ID};
  phalanx_collect(accel, &r, &tie.embree, collect_all);
  if (tie.ids.geometry == RTC_INVALID_GEOMETRY_ID) return;
  ids[0] = static_cast<int32>(tie.ids.geometry);
  ids[1] = static_cast<int32>(tie.ids.primitive);
  ids[2] = static_cast<int32>(tie.ids.instance);
}

extern "C" void phalanx_intersect_lanes(void *accel, float *rays, std::int64_t lanes,
                                        int32 width) {
  // A gang's rays hold each field for all lanes, in the order of RTCRayHit.
  constexpr int kNumFields = 20, kFar = 8, kFirstOfHit = 12;
  static_assert(sizeof(RTCRayHit) == kNumFields * sizeof(float));
  static_assert(offsetof(RTCRayHit, ray.tfar) == kFar * sizeof(float));
  static_assert(offsetof(RTCRayHit, hit) == kFirstOfHit * sizeof(float));
  for (int32 lane = 0; lane < width; ++lane) {
    if (((lanes >> lane) & 1) == 0) continue;
    alignas(RTCRayHit) float fields[kNumFields];
    for (int f = 0; f < kNumFields; ++f) fields[f] = rays[f * width + lane];
    RTCRayHit ray;
    std::memcpy(&ray, fields, sizeof ray);
    phalanx_intersect(accel, &ray, false);
    std::memcpy(fields, &ray, sizeof ray);
    rays[kFar * width + lane] = fields[kFar];
    for (int f = kFirstOfHit; f < kNumFields; ++f) rays[f * width + lane] = fields[f];
  }
}

Hit trace_closest(const SceneView &scene, Vec3 origin, Vec3 direction, float time) {
  if (!is_traceable(origin, direction) || is_black(direction)) {
    Hit none = {};
    none.geometry = none.instance = -1;
    return none;
  }
  RTCRayHit r;
  set_ray(r.ray, origin, direction, PHALANX_FAR, time, ray_id(scene, origin, direction));
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  phalanx_intersect(scene.accel, &r, false);
  Hit hit;
  hit.geometry = static_cast<int32>(r.hit.geomID);
  hit.primitive = static_cast<int32>(r.hit.primID);
  hit.instance = -1;
  hit.material = 0;
  hit.far_root = scene.num_spheres > 0 && r.hit.u >= 0.5f ? 1 : 0;
  auto instance = static_cast<int32>(r.hit.instID[0]);
  hit.time = time;
  hit.u = 0;
  const bool curve = hit.geometry >= 0 && hits_curve(scene, hit.geometry, instance);
  if (curve)
    hit.u = curve_hit_u(scene, instance, time, r.hit.u, {r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z},
                        direction);
  if (hit.geometry >= 0 && !curve && may_tie(r.hit.u, r.hit.v)) {
    const float ray[] = {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z,
                         time};
    int32 ids[] = {hit.geometry, hit.primitive, instance};
    phalanx_resolve_tie(scene.accel, ray, r.ray.tfar, r.ray.id, ids);
    hit.geometry = ids[0];
    hit.primitive = ids[1];
    instance = ids[2];
  }
  if (hit.geometry >= 0 && instance >= 0) {
    hit.instance = instance - scene.num_top_geometries;
    hit.geometry += scene.instances[hit.instance].first_geometry;
  }
  return hit;
}

bool trace_occluded(const SceneView &scene, Vec3 origin, Vec3 direction, float distance,
                    float time) {
  if (!is_traceable(origin, direction) || is_black(direction)) return false;
  RTCRay r;
  set_ray(r, origin, direction, distance, time, ray_id(scene, origin, direction));
  phalanx_occluded(scene.accel, &r, false);
  return r.tfar < 0;
}

}  // namespace phalanx
