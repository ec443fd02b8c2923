// An item of "materials": what light does at a surface.
#include "material_readers.h"
#include "texture_keys.h"

namespace phalanx {

namespace {

/// What scene files call a type, the kind that it is unless its parameters ask for another
/// (build_materials.cpp), and what reads its keys.
struct MaterialType {
  const char *name;
  MaterialKind kind;
  MaterialReader *read;
};

const std::vector<MaterialType> kMaterialTypes = {
    {"diffuse", kDiffuse, read_reflectance},
    {"mirror", kMirror, read_reflectance},
    {"dielectric", kDielectric, read_dielectric},
    {"conductor", kConductor, read_conductor},
    {"black", kBlack, read_nothing_more},
    {"rough_diffuse", kRoughDiffuse, read_rough_diffuse},
    {"thin_dielectric", kThinDielectric, read_thin_dielectric},
    {"coated_diffuse", kCoated, read_coated_diffuse},
    {"principled", kPrincipled, read_principled},
    {"phong", kPhong, read_phong},
    {"blinn_phong", kBlinnPhong, read_phong},
    {"hair", kHair, read_hair},
    {"blend", static_cast<MaterialKind>(kBlend), read_blend},
    {"null", kBlack, read_null},
};

/// The type that the key "type" names, or null.
const MaterialType *read_type(ObjectReader &object) {
  std::vector<Choice> names;
  for (const MaterialType &type : kMaterialTypes)
    names.push_back({type.name, static_cast<int>(names.size())});
  int index = 0;
  if (!object.choice("type", names, index, kRequired)) return nullptr;
  return &kMaterialTypes[static_cast<std::size_t>(index)];
}

/// True for kinds that normal maps can change; those of a blend are its parts'.
bool has_relief(MaterialKind kind) {
  return kind != kBlack && kind != kHair && static_cast<int>(kind) != kBlend;
}

void read_name(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  if (object.text("name", material.name, kRequired)) {
    reader.materials.add(material.name, *object.find("name"), reader.source);
  } else {
    reader.materials.add_nameless();
  }
}

/// Kinds whose back may be left black: those that light does not pass.
bool may_be_one_sided(MaterialKind kind) {
  switch (kind) {
    case kDiffuse:
    case kRoughDiffuse:
    case kMirror:
    case kConductor:
    case kCoated:
    case kPrincipled:
    case kPhong:
    case kBlinnPhong:
      return true;
    default:
      return false;
  }
}

}  // namespace

void read_null(ObjectReader &, SceneReader &, MaterialDescription &material) {
  material.is_null = true;
}

void read_nothing_more(ObjectReader &, SceneReader &, MaterialDescription &) {}

void read_reflectance(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  colour_or_texture(object, "reflectance", kUnitInterval, reader, material.reflectance,
                    material.textures.reflectance);
}

MaterialDescription read_material(const Node &node, SceneReader &reader) {
  MaterialDescription material;
  ObjectReader object(node, reader.source);
  read_name(object, reader, material);
  const MaterialType *const type = read_type(object);
  if (type == nullptr) {
    object.give_up("a material");
    return material;
  }
  material.kind = type->kind;
  type->read(object, reader, material);
  if (!material.is_null) {
    read_emission(object, reader, material);
    read_opacity(object, reader, material);
    if (has_relief(type->kind)) read_relief(object, reader, material);
    if (may_be_one_sided(type->kind)) object.boolean("one_sided", material.one_sided);
  }
  object.finish(std::string("a ") + type->name + " material");
  return material;
}

}  // namespace phalanx
