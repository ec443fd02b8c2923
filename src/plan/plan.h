// The plan: what this scene needs, as a value that can be printed, tested and compared.
//
// Kernels, queues and path-state columns that a scene cannot use do not exist in its plan, and the
// renderer builds only what the plan lists.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "../film/film.h"
#include "options.h"
#include "../scene/description.h"
#include "../scene/scene.h"

namespace phalanx {

/// A column of the path state, or of a queue: bytes for each path of a wave.
struct Column {
  std::string name;
  int bytes = 0;
};

struct LeftOut {
  std::string feature;   // "shadow rays"
  std::string reason;    // "the scene has no lights to sample"
  int bytes_per_path = 0;  // what it would have cost
};

struct Plan {
  // The picture. frame.filter_offsets points into the plan, which moves but is not copied.
  FrameView frame = {};
  std::vector<float> filter_offsets;
  Rect crop;                            // what is rendered of it
  int spp = 0;                          // at most; frame.spp is what a sampler may count on
  double time_limit_s = 0;              // 0: none
  double target_error = 0;              // relMSE; 0: none
  int replicates = 0;                   // 0: none; otherwise spp is a multiple of it
  bool adaptive = false;
  float clamp = 0;                      // see Film::set_clamp()
  // What the scene uses.
  bool material_kinds[kNumMaterialKinds] = {};
  bool sample_lights = false;           // next-event estimation, shadow queue
  bool instances = false;
  bool environment = false;
  bool aovs = false;
  bool spheres = false, disks = false;  // analytic: Embree user geometry
  bool curves = false;
  bool rich = false;                    // kRich kernels: textures, other lights, other materials ...
  bool blends = false;
  // What follows from that.
  std::vector<std::string> kernels;     // in the order of the main loop
  std::vector<std::int32_t> buckets;    // material kinds that paths can meet, ascending, and kEscaped
  std::vector<Column> columns;          // of the wave
  std::vector<LeftOut> left_out;
  int wave_size = 0, tile_size = 0, samples_per_pass = 0;
  int threads = 0;

  Plan() = default;
  Plan(Plan &&) = default;
  Plan &operator=(Plan &&) = default;

  int bytes_per_path() const;           // sum of the columns
  std::int64_t wave_bytes() const;      // per thread: columns and the tile's sample block
};

/// Memory in bytes, known before rendering starts.
struct MemoryPlan {
  std::int64_t scene = 0, film = 0, waves = 0;
  std::int64_t accel_estimate = 0;      // Embree, estimated from primitive counts
  std::int64_t replicates = 0;          // for the error estimate
  std::int64_t pilot = 0;               // adaptive sampling: while it is running
  std::int64_t total() const { return scene + film + waves + accel_estimate + replicates + pilot; }
};

/// Throws InputError for a frame that cannot be (size, crop window outside the picture).
Plan make_plan(const SceneDescription &description, const Scene &scene,
               const RenderOptions &options);
MemoryPlan plan_memory(const Plan &plan, const Scene &scene);

/// For people: a page of plain text ending with a newline.
std::string plan_text(const Plan &plan, const MemoryPlan &memory);

}  // namespace phalanx
