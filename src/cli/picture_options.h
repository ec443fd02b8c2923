// The options that say which picture is meant: the same for every command that looks at a scene as
// a picture.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "../plan/options.h"

namespace phalanx {

/// Adds SCENE and --mode, --spp, --time, --target-error, --error, --replicates, --adaptive, --sampler, --size,
/// --crop, --max-depth, --seed, --threads, --isa, --wave-size, --tile-size. Takes the command's
/// parse_complete_callback. `scene` and `options` must outlive the parsing. Bad values throw
/// InputError while parsing. `options.isa` is resolved later, by resolve_isa().
void add_picture_options(CLI::App &command, std::string &scene, RenderOptions &options);

}  // namespace phalanx
