// Textures as kernels read them.
#pragma once
#include "../core/error.h"
#include "description.h"
#include "scene.h"

namespace phalanx {

/// One Texture per description, same order, with texels and the table that decodes bytes. Reads the image
/// files, each once. Without textures nothing is allocated.
void build_textures(const SceneDescription &description, Scene &scene, Diagnostics &diagnostics);

/// What a material has from textures, maps and holes, which every kind may have.
void set_textures(const MaterialDescription &from, Material &material);

}  // namespace phalanx
