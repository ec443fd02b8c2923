#include "stages.h"

namespace phalanx {

const char *stage_name(int stage) {
  switch (stage) {
    case kStageGenerate: return "generate";
    case kStageIntersect: return "intersect";
    case kStageAov: return "aov";
    case kStageBucket: return "bucket";
    case kStageShade + int{kDiffuse}: return "shade diffuse";
    case kStageShade + int{kMirror}: return "shade mirror";
    case kStageShade + int{kDielectric}: return "shade dielectric";
    case kStageShade + int{kConductor}: return "shade conductor";
    case kStageShade + int{kBlack}: return "shade black";
    case kStageEscaped: return "shade escaped";
    case kStageShadow: return "shadow";
    case kStageCompact: return "compact";
    case kStageFilm: return "film";
    default: return "?";
  }
}

}  // namespace phalanx
