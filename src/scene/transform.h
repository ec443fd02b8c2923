// Affine maps in double precision.
#pragma once
#include "description.h"

namespace phalanx {

Double3 cross(const Double3 &a, const Double3 &b);
double dot(const Double3 &a, const Double3 &b);
double length(const Double3 &a);

Double3 transform_point(const Transform &transform, const Double3 &point);
Double3 transform_vector(const Transform &transform, const Double3 &vector);

/// The map that takes normals along (apply with transform_vector): its result is across the
/// transformed surface and on the side that the outside went to, also for mirrors. The cofactor
/// matrix with the sign of the determinant: it exists where the inverse does not. Entries are
/// at most 2; results are not normalised.
Transform normal_transform(const Transform &transform);

/// First `inner`, then `outer`.
Transform compose(const Transform &outer, const Transform &inner);

bool is_finite(const Transform &transform);
bool is_identity(const Transform &transform);

/// Determinant of the linear part divided by the cube of its Frobenius norm: its sign says whether
/// the map mirrors, and it does not depend on the unit of length. 0 for the zero map.
double relative_determinant(const Transform &transform);

/// The factor by which a similarity (rotation, mirror, equal scale in all directions) changes
/// lengths; 0 if the map changes angles or ratios by more than 1e-4, or is singular. The slack
/// admits matrices that were written with five digits.
double similarity_scale(const Transform &transform);

/// The inverse; relative_determinant() must not be 0.
Transform inverse(const Transform &transform);

Affine to_affine(const Transform &transform);

}  // namespace phalanx
