// Participating media: this program has none. Each case is listed all the same.
#include "groups.h"

namespace phalanx::check {

Group media_group() {
  constexpr const char *kReason = "the program has no participating media";
  const auto missing = [&](const char *id, const char *title) { return CaseInfo{id, title, nullptr, kReason}; };
  return {"media",
          {missing("V1", "a slab of optical thickness 1e4"), missing("V2", "vacuum, and infinite rays through it"),
           missing("V3", "phase functions from backward to forward peaked"),
           missing("V4", "albedo 1, optical thickness 1e3"), missing("V5", "extinction that differs by channel"),
           missing("V6", "null collisions with vanishing probability"), missing("V7", "voxels with NaN and denormals"),
           missing("V8", "camera in a medium, overlapping media"), missing("V9", "equiangular sampling along the light"),
           missing("V10", "10^3 boundaries along one ray")}};
}

}  // namespace phalanx::check
