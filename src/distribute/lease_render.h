// Rendering by leases: rank 0 leases tiles to itself and to others, keeps the film, and writes checkpoints.
// With one rank it is the same, without messages.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "../output/image.h"
#include "../render/render.h"
#include "partition.h"
#include "ranks.h"

namespace phalanx {

struct LeaseOptions {
  Balance balance = Balance::kDynamic;
  std::string checkpoint;          // file; empty: none
  double checkpoint_every_s = 60;
  bool resume = false;
  std::uint64_t scene_fingerprint = 0;
  std::vector<int> threads;        // of each rank
};

/// What the program that renders wants to know and to say meanwhile. All are called by one thread.
struct LeaseHooks {
  ProgressCallback progress;       // a few times a second; the film may be read. False: stop at once
  std::function<bool()> wants_snapshot;             // since it was asked last
  std::function<void(const Film &, const RunStats &)> snapshot;
  std::function<void(const std::string &)> warn;    // at once; also in the report
};

struct LeaseResult {
  Film film;
  RunStats stats;
  Image map;                       // channels rank (that rendered a pixel last), cost (seconds a sample)
  std::string checkpoint_failure;  // why the last checkpoint could not be written; empty: it was
};

/// Rank 0. The film's bits depend on what render()'s depend on. Throws InputError for a checkpoint that
/// does not fit; out of memory and the like end the other ranks, too.
LeaseResult render_leases(Ranks &ranks, const Scene &scene, const Accel &accel, const Plan &plan,
                          const RenderOptions &options, const LeaseOptions &lease_options,
                          const LeaseHooks &hooks);

/// The other ranks: render what rank 0 leases until it says that all is done, or has said nothing for
/// half a minute. False in the second case.
bool serve_leases(Ranks &ranks, const Scene &scene, const Accel &accel, const Plan &plan,
                  const RenderOptions &options);

/// Tiles no larger than the plan's, and so small that every thread gets a few.
int lease_tile_size(const Plan &plan, const std::vector<int> &threads);

}  // namespace phalanx
