// Which files a rendering writes: decided and checked before it starts, written when it is done.
#pragma once
#include <string>
#include <vector>

#include "../output/image.h"
#include "../plan/plan.h"

namespace phalanx {

struct Outputs {
  std::vector<std::string> images;
  std::string report;  // empty: none; "-": stdout
};

/// Without any -o: <stem of the scene>.exr and .png in the working directory.
Outputs choose_outputs(const std::string &scene, const std::vector<std::string> &images,
                       const std::string &report);

/// Throws InputError for an extension that is not known, an output that is the scene or is named
/// twice, layers without an EXR to hold them; WriteError for what cannot be written.
void check_outputs(const Outputs &outputs, const std::string &scene, bool with_layers);

/// Writes as many as it can, then throws one WriteError that names all that failed.
void write_outputs(const Outputs &outputs, const Image &image, double exposure,
                   const std::string &report);

}  // namespace phalanx
