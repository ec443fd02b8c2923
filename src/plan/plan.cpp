#include "plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "../../kernels/physics/sampler_blue_noise.h"
#include "../core/parallel.h"
#include "../film/replicates.h"
#include "../scene/build.h"
#include "../scene/build_lights.h"
#include "../scene/build_materials.h"
#include "columns.h"
#include "filter.h"

namespace phalanx {
namespace {

constexpr int kDefaultWaveSize = 2048;
constexpr int kDefaultTileSize = 32;
constexpr int kSamplesPerPass = 16;   // a power of two
constexpr int kFirstReplicatedSamples = 64;
constexpr int kAdaptiveSamples = 4;   // a tile may have a quarter of the others' samples
constexpr int kAdaptiveTileSize = 16;
constexpr int kMaxSide = 65535;       // pixel coordinates travel as 16 bits each

/// Upper estimate of the bytes that Embree keeps for a primitive; 65 (terrain) to 87 (spheres) were
/// measured on the scenes of bench/ (medium quality, robust).
constexpr std::int64_t kAccelBytesPerPrimitive = 96;

struct KindFacts {
  const char *name;
  bool has_density;
};
constexpr KindFacts kKinds[] = {
#define PHALANX_KIND(constant, name, density, transmits) {#name, density != 0},
    PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
};

int pick(int wanted, int otherwise) { return wanted > 0 ? wanted : otherwise; }

/// The next multiple of `unit`, at most kNoSampleLimit.
int round_up(int n, int unit) { return (std::min(n, kNoSampleLimit) + unit - 1) / unit * unit; }

/// How many samples, and how they are split. Without --spp, the scene's number is a limit only if there is
/// no other.
void set_budget(Plan &plan, const SceneDescription &d, const RenderOptions &o) {
  plan.time_limit_s = o.time_limit_s;
  plan.target_error = o.target_error;
  plan.adaptive = o.adaptive;
  plan.replicates = o.replicates;
  const bool other_limit = o.time_limit_s > 0 || o.target_error > 0;
  plan.spp = o.spp > 0 ? o.spp : other_limit ? kNoSampleLimit : d.sampler.spp;
  plan.frame.spp = pick(o.spp, d.sampler.spp);
  if (o.target_error > 0 && o.replicates == 0)
    throw InputError("a target for the error needs replicates to estimate it: --error on");
  if (o.adaptive) plan.spp = round_up(plan.spp, kAdaptiveSamples);
  if (o.replicates == 0) return;
  if (o.replicates < 2 || o.replicates > kFirstReplicatedSamples ||
      !std::has_single_bit(static_cast<unsigned>(o.replicates)))
    throw InputError(fmt::format("{} replicates: a power of two from 2 to {} is needed", o.replicates,
                                 kFirstReplicatedSamples));
  plan.spp = round_up(plan.spp, o.replicates * (o.adaptive ? kAdaptiveSamples : 1));
  plan.frame.spp = round_up(plan.frame.spp, o.replicates) / o.replicates;
}

void set_picture(Plan &plan, const SceneDescription &d, const RenderOptions &o) {
  FrameView &f = plan.frame;
  f.width = pick(o.width, d.film.width);
  f.height = pick(o.height, d.film.height);
  if (f.width > kMaxSide || f.height > kMaxSide || f.width < 1 || f.height < 1)
    throw InputError(fmt::format("picture of {} x {} pixels: each side must be 1 to {}", f.width,
                                 f.height, kMaxSide));
  const bool same_size = f.width == d.film.width && f.height == d.film.height;
  std::array<int, 4> crop = o.crop;
  if (crop[2] == 0 && same_size) crop = d.film.crop;
  plan.crop = crop[2] > 0 ? Rect{crop[0], crop[1], crop[2], crop[3]} : Rect{0, 0, f.width, f.height};
  const Rect &c = plan.crop;
  if (c.x < 0 || c.y < 0 || c.width < 1 || c.height < 1 || c.x > f.width - c.width ||
      c.y > f.height - c.height)
    throw InputError(fmt::format("crop window {},{},{},{} does not lie within the picture of {} x {}",
                                 c.x, c.y, c.width, c.height, f.width, f.height));
  set_budget(plan, d, o);
  plan.clamp = static_cast<float>(o.clamp);
  plan.filter_offsets = filter_offsets(d.film);
  f.filter_offsets = plan.filter_offsets.data();
  f.sampler = o.sampler.value_or(d.sampler.kind);
  if (f.sampler == kBlueNoiseSampler && blue_noise_bits(f.width, f.height, f.spp) > 32)
    throw InputError(fmt::format(
        "sampler blue_noise: {} x {} pixels with {} samples each need more than the 2^32 numbers there "
        "are; {} samples are possible",
        f.width, f.height, f.spp, 1 << std::min(30, 32 - blue_noise_bits(f.width, f.height, 1))));
  f.seed = o.seed.value_or(d.sampler.seed);
  f.max_depth = o.max_depth >= 0 ? o.max_depth : d.integrator.max_depth;
  f.roulette_depth = d.integrator.roulette_depth;
  f.integrator = d.integrator.kind;
  f.occlusion_distance = static_cast<float>(d.integrator.distance);
  Diagnostics diagnostics;
  f.camera = build_camera(d.camera, diagnostics);
  diagnostics.throw_if_errors();
}

/// Does a material have what the kernels of its kind do without in kPlain?
bool needs_rich_kernels(const Material &m) {
  return m.textured != 0 || m.one_sided != 0 || m.emission_texture >= 0 || m.normal_texture >= 0 ||
         m.bump_texture >= 0;
}

/// Marks the kind of a material, or of all that a blend can come down to.
void mark_kinds(Plan &plan, const Scene &scene, std::int32_t material) {
  const Material &m = scene.materials[static_cast<size_t>(material)];
  if (m.kind == kBlend) {
    plan.blends = true;
    mark_kinds(plan, scene, m.blend_a);
    mark_kinds(plan, scene, m.blend_b);
    return;
  }
  plan.material_kinds[m.kind] = true;
  plan.rich |= m.kind >= kNumBasicKinds || needs_rich_kernels(m);
}

/// True where more than half of the primitives are ones that Embree asks us about.
bool is_mostly_user_geometry(const Scene &scene) {
  std::int64_t ours = 0, all = 0;
  for (std::size_t g = 0; g < scene.geometries.size(); ++g) {
    const std::int32_t shape = scene.geometries[g].shape;
    all += scene.num_prims[g];
    if (shape == kSpheres || shape == kDisks) ours += scene.num_prims[g];
  }
  return 2 * ours > all;
}

void find_uses(Plan &plan, const Scene &scene) {
  for (const Geometry &g : scene.geometries) {
    mark_kinds(plan, scene, g.material);
    plan.spheres |= g.shape == kSpheres;
    plan.disks |= g.shape == kDisks;
    plan.curves |= g.shape == kCurves;
  }
  const bool paths = plan.frame.integrator == kPathIntegrator;
  plan.rich |= plan.blends || plan.curves || !scene.motions.empty() || !paths || has_rich_lights(scene);
  bool density = false;
  for (int kind = 0; kind < kNumMaterialKinds; ++kind) {
    density |= plan.material_kinds[kind] && kKinds[kind].has_density;
    if (plan.material_kinds[kind]) plan.buckets.push_back(kind);
  }
  plan.buckets.push_back(kEscaped);
  plan.sample_lights = plan.frame.integrator == kAmbientOcclusion ||
                       (paths && !scene.lights.empty() && plan.frame.max_depth > 0 && density);
  plan.instances = !scene.instances.empty();
  plan.frame.bounce_order = is_mostly_user_geometry(scene) ? kSingleRays : kIncoherentPackets;
  plan.environment = scene.has_environment;
}

void choose_kernels(Plan &plan) {
  const char *detail = plan.rich ? "_rich" : "";
  plan.kernels = {"generate", "intersect"};
  if (plan.blends) plan.kernels.push_back("resolve");
  if (plan.aovs) plan.kernels.push_back(fmt::format("aov{}", detail));
  plan.kernels.push_back("bucket");
  if (plan.frame.integrator != kPathIntegrator) {
    plan.kernels.push_back("shade_view");
  } else {
    for (int kind = 0; kind < kNumMaterialKinds; ++kind)
      if (plan.material_kinds[kind])
        plan.kernels.push_back(fmt::format("shade_{}{}", kKinds[kind].name, detail));
  }
  plan.kernels.push_back(fmt::format("shade_escaped{}", detail));
  if (plan.sample_lights) plan.kernels.push_back("shadow");
  plan.kernels.push_back("compact");
}

/// Bytes per path that a plan which uses everything would have and this one has not.
int bytes_without(const Plan &plan, bool Plan::*feature) {
  Plan with;
  with.wave_size = plan.wave_size;
  with.sample_lights = plan.sample_lights;
  with.instances = plan.instances;
  with.spheres = plan.spheres;
  const auto bytes = [](const Plan &p) {
    int sum = 0;
    for (const Column &c : wave_columns(p)) sum += c.bytes;
    return sum;
  };
  const int before = bytes(with);
  with.*feature = true;
  return bytes(with) - before;
}

void list_left_out(Plan &plan, const Scene &scene) {
  if (!plan.sample_lights) {
    const char *reason = scene.lights.empty()          ? "the scene has no lights to sample"
                         : plan.frame.max_depth == 0 ? "max_depth is 0"
                                                       : "every material is specular";
    plan.left_out.push_back({"light sampling, shadow rays", reason,
                             bytes_without(plan, &Plan::sample_lights)});
  }
  if (!plan.instances)
    plan.left_out.push_back({"instances", "none in the scene", bytes_without(plan, &Plan::instances)});
  if (!plan.environment) plan.left_out.push_back({"environment", "the scene has none", 0});
  if (!plan.aovs) plan.left_out.push_back({"albedo, normal, depth", "not asked for", 0});
  if (!plan.spheres)
    plan.left_out.push_back({"analytic spheres", "none in the scene",
                             bytes_without(plan, &Plan::spheres)});
  if (!plan.disks) plan.left_out.push_back({"analytic disks", "none in the scene", 0});
  // Other kinds are not listed: what a scene does without should not grow with what we learn.
  for (int kind = 0; kind < kNumBasicKinds; ++kind)
    if (!plan.material_kinds[kind])
      plan.left_out.push_back({fmt::format("shade_{}", kKinds[kind].name), "no such material", 0});
  if (plan.replicates == 0)
    plan.left_out.push_back(
        {"replicates for the error", fmt::format("not asked for (saves {} bytes a pixel)",
                                                 Replicates::bytes_per_pixel(kDefaultReplicates)), 0});
  if (plan.frame.camera.lens_radius == 0)
    plan.left_out.push_back({"lens samples",
                             plan.frame.camera.kind == kPerspective ? "pinhole camera" : "the camera has no lens",
                             0});
}

}  // namespace

int Plan::bytes_per_path() const {
  int sum = 0;
  for (const Column &c : columns) sum += c.bytes;
  return sum;
}

std::int64_t Plan::wave_bytes() const {
  const std::int64_t samples = std::int64_t{tile_size} * tile_size * samples_per_pass;
  const std::int64_t floats = 3 + (aovs ? PHALANX_AOV_FLOATS : 0);
  return std::int64_t{wave_size} * bytes_per_path() + samples * floats * 4;
}

Plan make_plan(const SceneDescription &description, const Scene &scene,
               const RenderOptions &options) {
  Plan plan;
  set_picture(plan, description, options);
  if (options.mode == Mode::kRecursive && plan.frame.max_depth > kMaxRecursiveDepth)
    throw InputError(fmt::format("recursive takes at most {} scattering events, not {}: each needs room on the stack. "
                                 "Try --max-depth, or depth-first",
                                 kMaxRecursiveDepth, plan.frame.max_depth));
  plan.aovs = options.aovs;
  plan.wave_size = pick(options.wave_size, kDefaultWaveSize);
  plan.tile_size = pick(options.tile_size, plan.adaptive ? kAdaptiveTileSize : kDefaultTileSize);
  if (!std::has_single_bit(static_cast<unsigned>(plan.tile_size)) || plan.tile_size > 256)
    throw InputError(fmt::format("tile size {}: a power of two up to 256 is needed", plan.tile_size));
  if (plan.wave_size < 16 || plan.wave_size > (1 << 20))
    throw InputError(fmt::format("wave size {}: 16 to 1048576 paths are possible", plan.wave_size));
  plan.samples_per_pass = kSamplesPerPass;
  plan.threads = pick(options.threads, max_threads());
  find_uses(plan, scene);
  choose_kernels(plan);
  plan.columns = wave_columns(plan);
  list_left_out(plan, scene);
  return plan;
}

MemoryPlan plan_memory(const Plan &plan, const Scene &scene) {
  MemoryPlan m;
  m.scene = scene.bytes();
  m.film = std::int64_t{plan.crop.width} * plan.crop.height * Film::bytes_per_pixel(plan.aovs);
  m.waves = plan.wave_bytes() * plan.threads;
  const std::int64_t pixels = std::int64_t{plan.crop.width} * plan.crop.height;
  m.replicates = pixels * Replicates::bytes_per_pixel(plan.replicates);
  if (plan.adaptive) {
    m.pilot = pixels * (Film::bytes_per_pixel(plan.aovs) +
                        Replicates::bytes_per_pixel(kPilotReplicates)) + m.waves;
  }
  for (std::int32_t n : scene.num_prims) m.accel_estimate += n * kAccelBytesPerPrimitive;
  return m;
}

namespace {

std::string budget_text(const Plan &plan) {
  std::vector<std::string> limits;
  if (plan.spp < kNoSampleLimit) limits.push_back(fmt::format("{} samples per pixel", plan.spp));
  if (plan.time_limit_s > 0) limits.push_back(fmt::format("{} s", plan.time_limit_s));
  if (plan.target_error > 0) limits.push_back(fmt::format("relMSE {}", plan.target_error));
  std::string text = fmt::format("{}", fmt::join(limits, " or "));
  if (plan.replicates > 0) text += fmt::format(" in {} replicates", plan.replicates);
  return text;
}

}  // namespace

std::string plan_text(const Plan &plan, const MemoryPlan &memory) {
  std::string text = fmt::format("picture   {} x {}, {}, depth {}\n", plan.crop.width,
                                 plan.crop.height, budget_text(plan), plan.frame.max_depth);
  text += "kernels   ";
  for (size_t i = 0; i < plan.kernels.size(); ++i)
    text += (i == 0 ? "" : " → ") + plan.kernels[i];
  text += fmt::format("\npath      {} bytes\n", plan.bytes_per_path());
  for (const Column &c : plan.columns) text += fmt::format("  {:>4}  {}\n", c.bytes, c.name);
  text += "left out\n";
  for (const LeftOut &l : plan.left_out) {
    text += fmt::format("        {}: {}", l.feature, l.reason);
    if (l.bytes_per_path > 0) text += fmt::format(" (saves {} bytes per path)", l.bytes_per_path);
    text += "\n";
  }
  text += fmt::format("wave      {} paths, tile {} x {}, {} threads\n", plan.wave_size,
                      plan.tile_size, plan.tile_size, plan.threads);
  const auto mb = [](std::int64_t bytes) { return static_cast<double>(bytes) / 1e6; };
  text += fmt::format(
      "memory    {:.1f} MB: scene {:.1f}, Embree about {:.1f}, film {:.1f}{}, waves {:.1f} ({:.2f} "
      "a thread)\n",
      mb(memory.total()), mb(memory.scene), mb(memory.accel_estimate), mb(memory.film),
      (memory.replicates > 0 ? fmt::format(", replicates {:.1f}", mb(memory.replicates)) : "") +
          (memory.pilot > 0 ? fmt::format(", pilot {:.1f}", mb(memory.pilot)) : ""),
      mb(memory.waves), mb(plan.wave_bytes()));
  return text;
}

}  // namespace phalanx
