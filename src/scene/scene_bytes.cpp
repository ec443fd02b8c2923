#include "scene_bytes.h"

#include "../core/crc32c.h"

namespace phalanx {

std::uint64_t scene_fingerprint(const Scene &scene) {
  Fingerprint print;
  visit_scene(
      scene,
      [&](const auto &array) {
        const std::uint64_t count = array.size();
        print.add(std::as_bytes(std::span(&count, 1)));
        print.add(std::as_bytes(std::span(array)));
      },
      [&](const auto &value) { print.add(std::as_bytes(std::span(&value, 1))); });
  return print.value();
}

}  // namespace phalanx
