// An item of "materials": what light does at a surface.
#include <cmath>

#include "metals.h"
#include "read_scene.h"

namespace phalanx {

namespace {

constexpr Range kIor = {1e-3, 1e5};
constexpr Range kEta = {1e-4, 1e5};
constexpr Range kAbsorption = {0, 1e5};

const std::vector<Choice> kMaterialTypes = {{"diffuse", kDiffuse},
                                            {"mirror", kMirror},
                                            {"dielectric", kDielectric},
                                            {"conductor", kConductor},
                                            {"black", kBlack}};

void read_metal(ObjectReader &object, MaterialDescription &material) {
  std::vector<Choice> names;
  for (const Metal &metal : metals()) names.push_back({metal.name, static_cast<int>(names.size())});
  int index = 0;
  if (!object.choice("metal", names, index)) return;
  const Metal &metal = metals()[static_cast<std::size_t>(index)];
  material.has_ior = true;
  material.eta = metal.eta;
  material.k = metal.k;
}

/// The colour of a metal: reflectance, or eta with k, or a metal by name.
void read_conductor_colour(ObjectReader &object, MaterialDescription &material) {
  const bool has_eta_or_k = object.has("eta") || object.has("k");
  if (object.has("reflectance") + has_eta_or_k + object.has("metal") > 1) {
    object.error("give only one of: reflectance; eta with k; metal");
  }
  object.colour("reflectance", kUnitInterval, material.reflectance);
  read_metal(object, material);
  if (has_eta_or_k) {
    material.has_ior = true;
    object.colour("eta", kEta, material.eta, kRequired);
    object.colour("k", kAbsorption, material.k, kRequired);
  }
}

void read_roughness(ObjectReader &object, MaterialDescription &material) {
  if (object.has("roughness") && object.has("alpha")) {
    object.error("give only one of: roughness; alpha, which is its square");
  }
  object.number("roughness", kUnitInterval, material.roughness);
  double alpha = 0;
  if (object.number("alpha", kUnitInterval, alpha)) material.roughness = std::sqrt(alpha);
}

void read_scattering(ObjectReader &object, MaterialDescription &material) {
  switch (material.kind) {
    case kDiffuse:
    case kMirror:
      object.colour("reflectance", kUnitInterval, material.reflectance);
      break;
    case kDielectric:
      object.number("ior", kIor, material.ior);
      break;
    case kConductor:
      read_conductor_colour(object, material);
      read_roughness(object, material);
      break;
    default:
      break;
  }
}

void read_name(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  if (object.text("name", material.name, kRequired)) {
    reader.materials.add(material.name, *object.find("name"), reader.source);
  } else {
    reader.materials.add_nameless();
  }
}

}  // namespace

MaterialDescription read_material(const Node &node, SceneReader &reader) {
  MaterialDescription material;
  ObjectReader object(node, reader.source);
  read_name(object, reader, material);
  int kind = kDiffuse;
  if (!object.choice("type", kMaterialTypes, kind, kRequired)) {
    object.give_up("a material");
    return material;
  }
  material.kind = static_cast<MaterialKind>(kind);
  read_scattering(object, material);
  object.colour("emission", kRadiance, material.emission);
  object.boolean("two_sided", material.two_sided);
  object.finish(std::string("a ") + kMaterialTypes[static_cast<std::size_t>(kind)].name +
                " material");
  if (object.ok() && material.two_sided && material.emission == Double3{0, 0, 0}) {
    reader.source.warn(node, "two_sided does nothing without emission");
  }
  return material;
}

}  // namespace phalanx
