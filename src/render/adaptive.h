// Where samples go: tiles get more of them where a pilot found more noise for the cost.
//
// The pilot's samples have scrambles of their own and are thrown away (the two-stage rule of Kirk and Arvo,
// "Unbiased sampling techniques for image synthesis", SIGGRAPH 1991). So the number of samples of a tile is
// independent of what they see, and their mean is unbiased, whatever the pilot has missed.
#pragma once
#include <vector>

#include "../plan/plan.h"
#include "../scene/accel.h"
#include "../scene/scene.h"

namespace phalanx {

/// What the pilot learned about a tile.
struct TileNoise {
  double noise = 0;  // sum over its pixels of the relative variance of a sample
  double cost = 0;   // rays that a sample of every pixel takes
};

/// Samples of a tile are those of the picture times 2^k: k for each tile, from kLeastShift to kMostShift.
/// The error of a tile is noise / samples, so that for a given cost it is least where samples go as
/// sqrt(noise / cost) (Neyman 1934). Their cost is at most that of the same number everywhere, and as near
/// to it as powers of two allow. Without noise: all 0.
std::vector<int> allocate_samples(const std::vector<TileNoise> &tiles);
inline constexpr int kLeastShift = -2, kMostShift = 3;

/// Samples of the pilot: an eighth of those of the picture, from 16 to 64.
int pilot_samples(const Plan &plan);

struct Pilot {
  std::vector<int> shifts;  // of each tile
  int spp = 0;
  double seconds = 0;
};
Pilot run_pilot(const Scene &scene, const Accel &accel, const Plan &plan, const RenderOptions &options);

}  // namespace phalanx
