// Ray queries over a scene: the one place, with kernels/trace.isph, where Embree is visible.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "scene.h"

namespace phalanx {

/// Embree's acceleration structures for a Scene, which must outlive it and must not move. Built for
/// one ISA so that the bits of a hit do not depend on the machine.
class Accel {
 public:
  /// `isa` as in RenderOptions (not empty); `threads` for building, 0 = all.
  /// Throws MemoryError when Embree runs out of memory.
  Accel(const Scene &scene, const std::string &isa, int threads);
  ~Accel();
  Accel(const Accel &) = delete;
  Accel &operator=(const Accel &) = delete;

  void *handle() const;                 // RTCScene
  std::int64_t bytes() const;           // held by Embree now
  static std::string library_version(); // "Embree 3.13.5"

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace phalanx
