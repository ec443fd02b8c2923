// Materials made of two others.
#include <algorithm>

#include "material_readers.h"
#include "texture_keys.h"

namespace phalanx {

namespace {

/// Looks up what the blends of a scene are made of. A part that cannot be is reported and left out.
class BlendFinder {
 public:
  BlendFinder(SceneReader &reader, std::vector<MaterialDescription> &materials)
      : source_(reader.source),
        names_(reader.materials),
        materials_(materials),
        depths_(materials.size(), kUnknown) {
    std::size_t next = 0;
    for (const MaterialDescription &material : materials)
      parts_.push_back(is_blend(material) ? reader.blends[next++] : BlendParts());
  }

  void find() {
    for (std::size_t i = 0; i < materials_.size(); i++) {
      if (!is_blend(materials_[i])) continue;
      materials_[i].blend_a = find_part(parts_[i].a);
      materials_[i].blend_b = find_part(parts_[i].b);
    }
    for (std::size_t i = 0; i < materials_.size(); i++) depth(static_cast<std::int32_t>(i));
  }

 private:
  static constexpr int kUnknown = -1;

  MaterialDescription &at(std::int32_t index) {
    return materials_[static_cast<std::size_t>(index)];
  }

  /// Index of the material that the node names, if it can be a part of a blend; else -1.
  std::int32_t find_part(const Node &node) {
    if (node.value == nullptr) return -1;  // reported
    const int errors_before = source_.num_errors();
    const std::int32_t index = names_.find(node.value->string(), node, source_);
    if (source_.num_errors() != errors_before) return -1;
    const MaterialDescription &part = at(index);
    if (part.name != node.value->string()) return -1;  // perhaps one without a readable name
    const std::string name = "material '" + printable(part.name) + "'";
    if (part.is_null) {
      source_.error(node, name + " is null; to let light through give the blend opacity");
    } else if (part.emission != Double3{0, 0, 0}) {
      source_.error(node, name + " emits; give the emission to the blend instead");
    } else if (part.opacity < 1 || part.textures.opacity >= 0) {
      source_.error(node, name + " has opacity; give it to the blend instead");
    } else {
      return index;
    }
    return -1;
  }

  /// How many blends are inside one another, 0 for a plain material. Blends that have no end or
  /// too many levels are reported once.
  int depth(std::int32_t index) {
    if (index < 0 || !is_blend(at(index))) return 0;
    const auto i = static_cast<std::size_t>(index);
    if (depths_[i] != kUnknown) return depths_[i];
    const auto before = std::find(chain_.begin(), chain_.end(), index);
    if (before != chain_.end()) return report_circle(before);
    if (chain_.size() == PHALANX_MAX_BLEND_DEPTH) return report_depth(chain_.front());
    chain_.push_back(index);
    const int below = std::max(depth(at(index).blend_a), depth(at(index).blend_b));
    chain_.pop_back();
    depths_[i] = below < PHALANX_MAX_BLEND_DEPTH ? below + 1 : report_depth(index);
    return depths_[i];
  }

  int report_circle(std::vector<std::int32_t>::iterator start) {
    std::string names;
    for (auto link = start; link != chain_.end(); ++link)
      names += printable(at(*link).name) + " -> ";
    source_.error(parts_[static_cast<std::size_t>(*start)].self,
                  "the blend is made of itself: " + names + printable(at(*start).name));
    return 0;
  }

  int report_depth(std::int32_t index) {
    source_.error(parts_[static_cast<std::size_t>(index)].self,
                  "blends are nested more than " + std::to_string(PHALANX_MAX_BLEND_DEPTH) +
                      " deep in '" + printable(at(index).name) + "'");
    return 0;
  }

  Source &source_;
  const NameTable &names_;
  std::vector<MaterialDescription> &materials_;
  std::vector<BlendParts> parts_;    // per material
  std::vector<int> depths_;          // per material
  std::vector<std::int32_t> chain_;  // blends being looked into, outermost first
};

}  // namespace

void read_blend(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  BlendParts parts = {object.node(), {}, {}};
  std::string name;
  if (object.text("a", name, kRequired)) parts.a = *object.find("a");
  if (object.text("b", name, kRequired)) parts.b = *object.find("b");
  number_or_texture(object, "weight", kUnitInterval, reader, material.weight,
                    material.textures.weight);
  reader.blends.push_back(parts);
}

void find_blended_materials(SceneReader &reader, std::vector<MaterialDescription> &materials) {
  BlendFinder(reader, materials).find();
}

}  // namespace phalanx
