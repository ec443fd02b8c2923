#include "stages.h"

namespace phalanx {

const char *stage_name(int stage) {
  switch (stage) {
    case kStageGenerate: return "generate";
    case kStageIntersect: return "intersect";
    case kStageResolve: return "resolve";
    case kStageView: return "shade view";
    case kStageAov: return "aov";
    case kStageBucket: return "bucket";
#define PHALANX_KIND(constant, name, density, transmits) \
  case kStageShade + int{constant}: return "shade " #name;
      PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
    case kStageEscaped: return "shade escaped";
    case kStageShadow: return "shadow";
    case kStageCompact: return "compact";
    case kStageFilm: return "film";
    default: return "?";
  }
}

}  // namespace phalanx
