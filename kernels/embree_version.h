// Embree 3.13 and 4 under one name, for C++ and ISPC. PHALANX_EMBREE is the major version.
//
//   phalanx_intersect(accel, &ray_hit, coherent)   closest hit of one ray (C++) or a gang (ISPC)
//   phalanx_occluded(accel, &ray, coherent)        sets tfar to -infinity where something is hit
#pragma once

#ifdef ISPC
#if PHALANX_EMBREE == 3
#include <embree3/rtcore.isph>
#else
#include <embree4/rtcore.isph>
#endif
#define PHALANX_QUERY static inline void
#define PHALANX_VARYING varying
#define PHALANX_UNIFORM uniform
#define PHALANX_INTERSECT rtcIntersectV
#define PHALANX_OCCLUDED rtcOccludedV
#else
#if PHALANX_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
#define PHALANX_QUERY static inline void
#define PHALANX_VARYING
#define PHALANX_UNIFORM
#define PHALANX_INTERSECT rtcIntersect1
#define PHALANX_OCCLUDED rtcOccluded1
#endif

#if PHALANX_EMBREE == 3

PHALANX_QUERY phalanx_intersect(void *PHALANX_UNIFORM accel,
                                PHALANX_VARYING RTCRayHit *PHALANX_UNIFORM ray,
                                PHALANX_UNIFORM bool coherent) {
  PHALANX_UNIFORM RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                           : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  PHALANX_INTERSECT((PHALANX_UNIFORM RTCScene)accel, &context, ray);
}

PHALANX_QUERY phalanx_occluded(void *PHALANX_UNIFORM accel,
                               PHALANX_VARYING RTCRay *PHALANX_UNIFORM ray,
                               PHALANX_UNIFORM bool coherent) {
  PHALANX_UNIFORM RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                           : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  PHALANX_OCCLUDED((PHALANX_UNIFORM RTCScene)accel, &context, ray);
}

#else

PHALANX_QUERY phalanx_intersect(void *PHALANX_UNIFORM accel,
                                PHALANX_VARYING RTCRayHit *PHALANX_UNIFORM ray,
                                PHALANX_UNIFORM bool coherent) {
  PHALANX_UNIFORM RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  PHALANX_INTERSECT((PHALANX_UNIFORM RTCScene)accel, ray, &arguments);
}

PHALANX_QUERY phalanx_occluded(void *PHALANX_UNIFORM accel,
                               PHALANX_VARYING RTCRay *PHALANX_UNIFORM ray,
                               PHALANX_UNIFORM bool coherent) {
  PHALANX_UNIFORM RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  PHALANX_OCCLUDED((PHALANX_UNIFORM RTCScene)accel, ray, &arguments);
}

#endif

#ifndef ISPC
// A query that shows every hit of one ray to a filter, for src/scene/accel.cpp. The filter's context is
// the given one; phalanx_collects() tells it from that of an ordinary query.
#if PHALANX_EMBREE == 3

using PhalanxQueryContext = RTCIntersectContext;
#define PHALANX_FILTER_SCENE_FLAG RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION

static inline bool phalanx_collects(const PhalanxQueryContext *context) {
  return context->filter != nullptr;
}
static inline void phalanx_collect(void *accel, RTCRayHit *ray, PhalanxQueryContext *context,
                                   RTCFilterFunctionN filter) {
  rtcInitIntersectContext(context);
  context->filter = filter;
  rtcIntersect1(static_cast<RTCScene>(accel), context, ray);
}
// A query of a scene from the callback of a query of another one, with that one's context.
static inline void phalanx_intersect_inner(RTCScene scene, PhalanxQueryContext *context,
                                           RTCRayHit *ray) {
  rtcIntersect1(scene, context, ray);
}
static inline void phalanx_occluded_inner(RTCScene scene, PhalanxQueryContext *context,
                                          RTCRay *ray) {
  rtcOccluded1(scene, context, ray);
}

#else

using PhalanxQueryContext = RTCRayQueryContext;
#define PHALANX_FILTER_SCENE_FLAG RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS

// While a thread collects, this is its context.
inline thread_local const RTCRayQueryContext *phalanx_collecting = nullptr;
inline thread_local RTCFilterFunctionN phalanx_collecting_filter = nullptr;

static inline bool phalanx_collects(const PhalanxQueryContext *context) {
  return context != nullptr && context == phalanx_collecting;
}
static inline void phalanx_collect(void *accel, RTCRayHit *ray, PhalanxQueryContext *context,
                                   RTCFilterFunctionN filter) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  rtcInitRayQueryContext(context);
  arguments.context = context;
  arguments.filter = filter;
  arguments.flags = static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_INCOHERENT |
                                                  RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  phalanx_collecting = context;
  phalanx_collecting_filter = filter;
  rtcIntersect1(static_cast<RTCScene>(accel), ray, &arguments);
  phalanx_collecting = nullptr;
}
// A query of a scene from the callback of a query of another one, with that one's context.
static inline void phalanx_intersect_inner(RTCScene scene, PhalanxQueryContext *context,
                                           RTCRayHit *ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = context;
  if (phalanx_collects(context)) {
    arguments.filter = phalanx_collecting_filter;
    arguments.flags = static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_INCOHERENT |
                                                    RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  }
  rtcIntersect1(scene, ray, &arguments);
}
static inline void phalanx_occluded_inner(RTCScene scene, PhalanxQueryContext *context,
                                          RTCRay *ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = context;
  rtcOccluded1(scene, ray, &arguments);
}

#endif
#endif
