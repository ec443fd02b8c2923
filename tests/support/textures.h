// Textures for tests: with their texels, as a scene would hold them.
#pragma once
#include <vector>

#include "../../kernels/physics/texture.h"
#include "random.h"

namespace phalanx::test {

/// Texture coordinates are uv; both colours are white and black.
Texture plain_texture(TextureKind kind);

struct TextureSet {
  std::vector<Texture> textures;
  std::vector<uint32> byte_texels;
  std::vector<float> float_texels, decode;

  TextureSet();  // with the table that decodes bytes
  /// All return the index of the texture. Rows from the top; four floats a texel.
  int32 add(const Texture &texture);
  int32 add_bytes(Texture texture, int32 width, int32 height, const std::vector<uint32> &texels);
  int32 add_floats(Texture texture, int32 width, int32 height, const std::vector<float> &texels);

  /// Lets the view see these textures; valid while this lives and does not change.
  void put_into(SceneView &view) const;
  SceneView view() const;  // of nothing else
};

/// Images of both formats and of many sizes, with every wrap and filter, and patterns; transformed.
TextureSet random_textures(Random &random);

}  // namespace phalanx::test
