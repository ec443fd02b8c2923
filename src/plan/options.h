// What a user can ask of a picture. Defaults come from the scene file.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace phalanx {

/// How the one estimator is scheduled. All but kRecursive give the same bits.
enum class Mode { kWavefront, kMegakernel, kDepthFirst, kRecursive };

/// Scattering events that recursive takes: each needs a frame of the thread's stack.
constexpr int kMaxRecursiveDepth = 2000;

const char *mode_name(Mode mode);                         // "wavefront", "depth-first", ...
std::optional<Mode> mode_from_name(const std::string &name);

/// Replicates of --error on. Student's t with 15 degrees of freedom widens an interval by 9 %.
inline constexpr int kDefaultReplicates = 16;
/// Samples per pixel of a picture that only time, an error or a signal ends.
inline constexpr int kNoSampleLimit = 1 << 26;

/// Of the pilot of adaptive sampling.
inline constexpr int kPilotReplicates = 4;

struct RenderOptions {
  Mode mode = Mode::kWavefront;
  int spp = 0;                  // samples per pixel; 0: the scene's, or with another limit none
  int width = 0, height = 0;    // 0 takes the scene's
  std::array<int, 4> crop = {0, 0, 0, 0};  // x, y, w, h in pixels; w = 0: the scene's
  int max_depth = -1;           // -1 takes the scene's
  std::optional<int> seed;      // none takes the scene's
  double clamp = 0;             // largest channel of a sample, W sr^-1 m^-2; 0: no limit
  double time_limit_s = 0;      // 0: no limit. Otherwise passes until it is used up, at least one
  double target_error = 0;      // relMSE to render down to; 0: none. Needs replicates
  int replicates = 0;           // independent scrambles for an error estimate: a power of two; 0: none
  bool adaptive = false;        // more samples where a pilot found more noise
  std::optional<int> sampler;   // SamplerKind; none takes the scene's
  int threads = 0;              // 0: all that OpenMP offers
  std::string isa;              // "sse4", "avx2", "avx512skx"; empty: the best one here
  bool aovs = false;            // albedo, normal, depth planes
  int wave_size = 0;            // paths per wave; 0: the default
  int tile_size = 0;            // pixels along a tile's side, a power of two; 0: the default
};

}  // namespace phalanx
