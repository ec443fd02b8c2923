#include "inner_scene.h"

#include <cmath>
#include <limits>

#include "../../kernels/physics/motion.h"

namespace phalanx {
namespace {

/// The box of a moving group when the shutter opens (step 0) and closes (1): points of the group move in
/// straight lines, so the boxes between hold them between.
void inner_bounds(const RTCBoundsFunctionArguments *args) {
  const auto *inner = static_cast<const InnerScene *>(args->geometryUserPtr);
  const float metres = 1 / inner->scale;
  Affine place = {metres, 0, 0, 0, 0, metres, 0, 0, 0, 0, metres, 0};
  if (inner->is_group())
    place = args->timeStep == 0 ? inner->view->instances[inner->instance].to_world
                                : inner->view->motions[inner->instance].to_world_end;
  RTCBounds box;
  rtcGetSceneBounds(inner->scene, &box);
  Vec3 lo = {PHALANX_FAR, PHALANX_FAR, PHALANX_FAR}, hi = neg(lo);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = {corner & 1 ? box.upper_x : box.lower_x, corner & 2 ? box.upper_y : box.lower_y,
                    corner & 4 ? box.upper_z : box.lower_z};
    const Vec3 q = transform_point(place, p), slack = transform_abs(place, abs3(p)) * 1e-5f;
    lo = {min_of(lo.x, q.x - slack.x), min_of(lo.y, q.y - slack.y), min_of(lo.z, q.z - slack.z)};
    hi = max3(hi, q + slack);
  }
  *args->bounds_o = {lo.x, lo.y, lo.z, 0, hi.x, hi.y, hi.z, 0};
}

/// Ray i of a packet as the inner scene sees it; distances along it are the same.
RTCRay ray_inside(const InnerScene &inner, RTCRayN *rays, unsigned n, unsigned i) {
  RTCRay ray = rtcGetRayFromRayN(rays, n, i);
  Vec3 o = Vec3{ray.org_x, ray.org_y, ray.org_z} * inner.scale;
  Vec3 d = Vec3{ray.dir_x, ray.dir_y, ray.dir_z} * inner.scale;
  if (inner.is_group()) {
    const Instance at = instance_at(*inner.view, inner.instance, ray.time);
    o = transform_point(at.to_object, o);
    d = transform_vector(at.to_object, d);
  }
  ray.org_x = o.x;
  ray.org_y = o.y;
  ray.org_z = o.z;
  ray.dir_x = d.x;
  ray.dir_y = d.y;
  ray.dir_z = d.z;
  return ray;
}

void inner_intersect(const RTCIntersectFunctionNArguments *args) {
  const auto *inner = static_cast<const InnerScene *>(args->geometryUserPtr);
  RTCRayN *rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN *hits = RTCRayHitN_HitN(args->rayhit, args->N);
  const unsigned outside = args->context->instID[0];
  if (inner->is_group()) args->context->instID[0] = args->geomID;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    RTCRayHit r;
    r.ray = ray_inside(*inner, rays, args->N, i);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    phalanx_intersect_inner(inner->scene, args->context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    RTCRayN_tfar(rays, args->N, i) = r.ray.tfar;
    r.hit.instID[0] = args->context->instID[0];
    rtcCopyHitToHitN(hits, &r.hit, args->N, i);
  }
  args->context->instID[0] = outside;
}

void inner_occluded(const RTCOccludedFunctionNArguments *args) {
  const auto *inner = static_cast<const InnerScene *>(args->geometryUserPtr);
  const unsigned outside = args->context->instID[0];
  if (inner->is_group()) args->context->instID[0] = args->geomID;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    RTCRay ray = ray_inside(*inner, args->ray, args->N, i);
    phalanx_occluded_inner(inner->scene, args->context, &ray);
    if (ray.tfar < 0)
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
  args->context->instID[0] = outside;
}

}  // namespace

float strand_scale(const Scene &scene, const int32 *first, std::size_t n) {
  double sum = 0, reach = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const float *const p = &scene.curve_points[4 * static_cast<std::size_t>(first[i])];
    const Vec3 a = {p[0], p[1], p[2]}, b = {p[4], p[5], p[6]};
    sum += static_cast<double>(length((b - a) * (1 / max_component(abs3(b - a))))) *
           static_cast<double>(max_component(abs3(b - a)));
    reach = std::max(reach, static_cast<double>(max_component(max3(abs3(a), abs3(b)))));
  }
  const double wanted = std::log2(16 * static_cast<double>(n) / sum);
  return static_cast<float>(std::exp2(std::floor(std::min(wanted, 50 - std::log2(reach)))));
}

void set_inner_scene(RTCGeometry geometry, InnerScene *inner) {
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  if (inner->is_group()) rtcSetGeometryTimeStepCount(geometry, 2);
  rtcSetGeometryUserData(geometry, inner);
  rtcSetGeometryBoundsFunction(geometry, inner_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, inner_intersect);
  rtcSetGeometryOccludedFunction(geometry, inner_occluded);
}

}  // namespace phalanx
