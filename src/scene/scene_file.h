// The scene file: JSON, version 1, described in docs/scene-format.md and docs/scene.schema.json.
//
// The work is split by family: read_scene.h lists the parts. A file with errors gives a description
// that must not be used; ask the diagnostics.
#pragma once
#include <string>

#include "../core/error.h"
#include "description.h"

namespace phalanx {

/// The format that this program reads, and the only one so far.
constexpr int kSceneVersion = 1;

/// Larger scene files are refused: big meshes belong into OBJ or PLY files.
constexpr std::size_t kMaxSceneBytes = 64u << 20;

/// Reads and checks a scene file; path "-" reads standard input. References to other files are
/// relative to the folder of the scene file (standard input: to the working directory). All problems
/// of the file are in `diagnostics`: errors, and warnings about what is allowed but hardly meant.
/// Nothing is generated and no big memory taken before the file is known to be good.
SceneDescription load_scene_file(const std::string &path, Diagnostics &diagnostics);

/// The same for a text in memory; `name` stands for the file in messages.
SceneDescription parse_scene_text(const std::string &text, const std::string &name,
                                  const std::string &base_dir, Diagnostics &diagnostics);

}  // namespace phalanx
