#include "options.h"

namespace phalanx {

const char *mode_name(Mode mode) {
  switch (mode) {
    case Mode::kWavefront: return "wavefront";
    case Mode::kMegakernel: return "megakernel";
    case Mode::kDepthFirst: return "depth-first";
    case Mode::kRecursive: return "recursive";
  }
  return "?";
}

std::optional<Mode> mode_from_name(const std::string &name) {
  for (Mode m : {Mode::kWavefront, Mode::kMegakernel, Mode::kDepthFirst, Mode::kRecursive})
    if (name == mode_name(m)) return m;
  return std::nullopt;
}

}  // namespace phalanx
