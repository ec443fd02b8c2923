#include "build.h"

#include <algorithm>
#include <cmath>

#include "build_geometry.h"
#include "build_lights.h"
#include "build_materials.h"
#include "build_report.h"
#include "build_textures.h"
#include "transform.h"

namespace phalanx {
namespace {

using std::size_t;

/// Puts the scene together: top level, groups, instances, lights, bounds.
class SceneBuilder {
 public:
  SceneBuilder(const SceneDescription &description, Diagnostics &diagnostics)
      : description_(description), diagnostics_(diagnostics), geometry_(scene_, diagnostics) {}

  Scene build() {
    scene_.materials = build_materials(description_, scene_.tables, scene_.notes, diagnostics_);
    build_textures(description_, scene_, diagnostics_);
    scene_.has_environment = description_.has_environment;
    for (size_t i = 0; i < 3; ++i)
      (&scene_.environment.x)[i] = static_cast<float>(description_.environment[i]);
    geometry_.reserve(description_);
    check_instances();
    add_top_level();
    add_groups();
    note_null_shapes();
    add_instances();
    find_bounds();
    build_lights(scene_, description_, diagnostics_);
    scene_.positions.insert(scene_.positions.end(), kPositionPadding, 0.0f);
    return std::move(scene_);
  }

 private:
  bool emits(const ShapeDescription &shape) const {
    const auto material = static_cast<size_t>(shape.material);
    return shape.material >= 0 && material < scene_.materials.size() &&
           emitted_luminance(scene_.materials[material]) > 0;
  }

  /// Light passes through shapes without a surface. They have no records.
  bool has_surface(const ShapeDescription &shape) const {
    const auto material = static_cast<size_t>(shape.material);
    return shape.material < 0 || material >= description_.materials.size() ||
           !description_.materials[material].is_null;
  }
  void note_null_shapes();

  std::int32_t num_geometries() const {
    return static_cast<std::int32_t>(scene_.geometries.size());
  }

  void check_instances();
  void add_top_level();
  void add_groups();
  void add_instances();
  void find_bounds();

  const SceneDescription &description_;
  Diagnostics &diagnostics_;
  Scene scene_;
  GeometryBuilder geometry_;
  std::vector<const InstanceDescription *> valid_instances_;
  std::vector<Bounds> group_bounds_;
};

/// What to_world becomes in the kernels' precision: its inverse must undo the rounded map.
Transform rounded(const Transform &transform) {
  Transform result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      result.m[i][j] = static_cast<double>(static_cast<float>(transform.m[i][j]));
  return result;
}

bool fits_float(const Transform &transform) {
  for (const auto &row : transform.m)
    for (const double entry : row)
      if (!(std::fabs(entry) <= static_cast<double>(PHALANX_FAR))) return false;
  return true;
}

/// Empty, or why the transform cannot place a group. STABILITY: S7.
std::string check_transform(const Transform &transform) {
  if (!is_finite(transform) || !fits_float(transform)) return "the transform is not finite";
  constexpr double kLeastDeterminant = 1e-30;  // relative to the cube of the norm
  if (!(std::fabs(relative_determinant(transform)) >= kLeastDeterminant) ||
      !(std::fabs(relative_determinant(rounded(transform))) >= kLeastDeterminant))
    return "the transform is singular: it flattens the group; is a scale 0?";
  if (!fits_float(inverse(rounded(transform))))
    return "the transform makes the group too small for 32-bit numbers";
  return {};
}

bool has_curves(const GroupDescription &group) {
  return std::any_of(group.shapes.begin(), group.shapes.end(), [](const ShapeDescription &shape) {
    return std::holds_alternative<CurvesShape>(shape.shape);
  });
}

/// Empty, or why a group cannot move from one transform to the other. `similar`: only by similarities.
std::string check_motion(const Transform &from, const Transform &to, bool similar) {
  const std::string problem = check_transform(to);
  if (!problem.empty()) return "transform_end: " + problem;
  constexpr int kSteps = 64;
  constexpr double kLeastDeterminant = 1e-3;  // relative to the cube of the norm, where a rotation has 0.19
  const bool mirrors = relative_determinant(from) < 0;
  for (int step = 0; step <= kSteps; ++step) {
    Transform between;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j)
        between.m[i][j] = from.m[i][j] + (to.m[i][j] - from.m[i][j]) * step / kSteps;
    if (similar && !(similarity_scale(between) > 0))
      return "a group with curves cannot turn while it moves";
    const double determinant = relative_determinant(between) * (mirrors ? -1 : 1);
    if (!(determinant >= kLeastDeterminant * std::min(1.0, std::fabs(relative_determinant(from)) / 0.19)))
      return "the group becomes flat on its way from transform to transform_end: does it turn too far?";
  }
  return {};
}

void SceneBuilder::check_instances() {
  for (const InstanceDescription &instance : description_.instances) {
    const bool has_group =
        instance.group >= 0 && static_cast<size_t>(instance.group) < description_.groups.size();
    std::string problem = has_group ? check_transform(instance.transform)
                                    : "there is no group " + std::to_string(instance.group);
    if (problem.empty() && !(similarity_scale(instance.transform) > 0) &&
        has_curves(description_.groups[static_cast<size_t>(instance.group)]))
      problem = "a group with curves can be moved, turned, mirrored and scaled equally in all "
                "directions only";
    if (problem.empty() && instance.transform_end) {
      const GroupDescription &group = description_.groups[static_cast<size_t>(instance.group)];
      problem = check_motion(instance.transform, *instance.transform_end, has_curves(group));
      for (const ShapeDescription &shape : group.shapes)
        if (emits(shape)) problem = "group '" + group.name + "' holds shapes that emit: it cannot move";
    }
    if (problem.empty())
      valid_instances_.push_back(&instance);
    else
      diagnostics_.error(problem_at(instance.origin, problem));
  }
}

void SceneBuilder::add_top_level() {
  for (const ShapeDescription &shape : description_.shapes)
    if (has_surface(shape)) geometry_.add(shape, shape.transform, shape.origin);
  for (const InstanceDescription *instance : valid_instances_)
    for (const ShapeDescription &shape :
         description_.groups[static_cast<size_t>(instance->group)].shapes)
      if (emits(shape))
        geometry_.add(shape, compose(instance->transform, shape.transform),
                      shape.origin + " placed by " + instance->origin);
  scene_.top_level = {0, num_geometries()};
}

void SceneBuilder::add_groups() {
  for (const GroupDescription &group : description_.groups) {
    const std::int32_t first = num_geometries();
    geometry_.start_group();
    int num_emitting = 0;
    for (const ShapeDescription &shape : group.shapes) {
      if (emits(shape))
        ++num_emitting;
      else if (has_surface(shape))
        geometry_.add(shape, shape.transform, shape.origin);
    }
    scene_.groups.push_back({first, num_geometries() - first});
    Bounds bounds;
    for (std::int32_t g = first; g < num_geometries(); ++g)
      bounds.add(geometry_.bounds()[static_cast<size_t>(g)]);
    group_bounds_.push_back(bounds);
    if (num_emitting > 0)
      scene_.notes.push_back(std::to_string(num_emitting) + " emitting shapes of group '" +
                             group.name + "' copied to the top level for each instance");
  }
}

void SceneBuilder::note_null_shapes() {
  int num_null = 0;
  for (const ShapeDescription &shape : description_.shapes) num_null += !has_surface(shape);
  for (const GroupDescription &group : description_.groups)
    for (const ShapeDescription &shape : group.shapes) num_null += !has_surface(shape);
  if (num_null > 0)
    scene_.notes.push_back(std::to_string(num_null) + " shapes of null materials left out");
}

void SceneBuilder::add_instances() {
  for (const InstanceDescription *from : valid_instances_) {
    const GeometryRange group = scene_.groups[static_cast<size_t>(from->group)];
    if (group.count == 0) continue;
    const Bounds &bounds = group_bounds_[static_cast<size_t>(from->group)];
    for (int corner = 0; corner < 8; ++corner) {
      const Double3 p = transform_point(from->transform, {corner & 1 ? bounds.hi.x : bounds.lo.x,
                                                          corner & 2 ? bounds.hi.y : bounds.lo.y,
                                                          corner & 4 ? bounds.hi.z : bounds.lo.z});
      if (is_valid_point(p)) continue;
      diagnostics_.error(problem_at(from->origin, "the instance reaches to " + point_text(p) +
                                                      ": coordinates must be at most 1.8e18"));
      break;
    }
    Instance instance = {};
    instance.first_geometry = group.first;
    instance.to_world = to_affine(from->transform);
    instance.to_object = to_affine(inverse(rounded(from->transform)));
    scene_.instances.push_back(instance);
    Motion motion = {};
    motion.moves = from->transform_end ? 1 : 0;
    motion.to_world_end = to_affine(from->transform_end.value_or(from->transform));
    scene_.motions.push_back(motion);
    scene_.instance_group.push_back(from->group);
  }
  const auto moves = [](const Motion &motion) { return motion.moves != 0; };
  if (std::none_of(scene_.motions.begin(), scene_.motions.end(), moves)) scene_.motions.clear();
}

void SceneBuilder::find_bounds() {
  Bounds world;
  for (std::int32_t g = 0; g < scene_.top_level.count; ++g)
    world.add(geometry_.bounds()[static_cast<size_t>(g)]);
  for (size_t i = 0; i < scene_.instances.size(); ++i) {
    const Bounds &bounds = group_bounds_[static_cast<size_t>(scene_.instance_group[i])];
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = vec3(corner & 1 ? bounds.hi.x : bounds.lo.x, corner & 2 ? bounds.hi.y : bounds.lo.y,
                          corner & 4 ? bounds.hi.z : bounds.lo.z);
      world.add(transform_point(scene_.instances[i].to_world, p));
      if (!scene_.motions.empty()) world.add(transform_point(scene_.motions[i].to_world_end, p));
    }
  }
  scene_.bounds_lo = world.lo;
  scene_.bounds_hi = world.hi;
}

}  // namespace

Scene build_scene(const SceneDescription &description, Diagnostics &diagnostics) {
  return SceneBuilder(description, diagnostics).build();
}

}  // namespace phalanx
