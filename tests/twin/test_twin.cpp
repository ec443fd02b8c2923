// One text, two compilers, the same bits: every physics function in ISPC, at every width that this
// processor runs, against C++.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "functions.h"
#include "support/rich_lights.h"
#include "support/toy_scene.h"
#include "wavefront/isa.h"

using namespace phalanx;
using namespace phalanx::test;

using TwinKernel = void(const SceneView *, const FrameView *, const float *, const int32 *, float *,
                        int32);
// Weak: null for instruction sets that this build leaves out.
#define TWIN_DECLARE(name, floats, ints, results) \
  extern "C" __attribute__((weak)) TwinKernel twin_##name##_sse4, twin_##name##_avx2, twin_##name##_avx512skx;
TWIN_LIST(TWIN_DECLARE)

namespace {

constexpr int kRows = 100003;  // no multiple of any width: the last gang is partial

struct Twin {
  const char *name;
  int floats, ints, results;
  TwinOut (*scalar)(const SceneView &, const FrameView &, TwinIn);
  TwinKernel *kernels[3];  // sse4, avx2, avx512skx
};
#define TWIN_ROW(name, floats, ints, results) \
  {#name,   floats,       ints,               \
   results, &twin_##name, {&twin_##name##_sse4, &twin_##name##_avx2, &twin_##name##_avx512skx}},
const Twin kTwins[] = {TWIN_LIST(TWIN_ROW)};

/// Equal bits; a NaN equals any NaN (which one survives depends on the order of operands).
bool same(float a, float b) {
  return std::bit_cast<int32>(a) == std::bit_cast<int32>(b) || (std::isnan(a) && std::isnan(b));
}

/// Zeros, ones, steps of one ulp, tiny, huge.
float edge_value(Random &random) {
  constexpr float kValues[] = {0.0f,         -0.0f,    1.0f,   -1.0f,   0.5f,   1 - 0x1p-24f,
                               1 + 0x1p-23f, 0x1p-24f, 1e-20f, -1e-20f, 1e-37f, 1e10f,
                               -1e10f,       1e18f,    0.25f,  2.0f};
  return kValues[random.below(static_cast<int>(std::size(kValues)))];
}

class Columns {
 public:
  Columns(int floats, int ints)
      : f_(static_cast<std::size_t>(floats) * kRows), i_(static_cast<std::size_t>(ints) * kRows) {}
  float &f(int column, int row) { return f_[static_cast<std::size_t>(column * kRows + row)]; }
  int32 &i(int column, int row) { return i_[static_cast<std::size_t>(column * kRows + row)]; }
  void put(int column, int row, Vec3 v) {
    f(column, row) = v.x;
    f(column + 1, row) = v.y;
    f(column + 2, row) = v.z;
  }
  const float *floats() const { return f_.data(); }
  const int32 *ints() const { return i_.data(); }

 private:
  std::vector<float> f_;
  std::vector<int32> i_;
};

/// Unit square in most rows; the rest are edge cases.
void fill_random(Columns &in, const Twin &twin, Random &random, float lo, float hi) {
  for (int row = 0; row < kRows; ++row) {
    for (int c = 0; c < twin.floats; ++c)
      in.f(c, row) = random.chance(0.1) ? edge_value(random) : random.between(lo, hi);
    for (int c = 0; c < twin.ints; ++c)
      in.i(c, row) = random.chance(0.1) ? random.below(3) - 1 : static_cast<int32>(random.bits());
  }
}

/// Two directions above the surface from float 0 on.
void fill_directions(Columns &in, Random &random) {
  for (int row = 0; row < kRows; ++row)
    for (const int c : {0, 3}) {
      Vec3 w = random.direction();
      const bool grazing = random.chance(0.05);
      w.z = std::fabs(grazing ? w.z * 1e-4f : w.z) + 1e-7f;
      in.put(c, row, random.chance(0.02) ? vec3(0, 0, 1) : normalize(w));
    }
}

void fill_bsdf(Columns &in, const Twin &twin, const ToyScene &scene, Random &random) {
  fill_random(in, twin, random, 0, 1 - 0x1p-24f);
  fill_directions(in, random);
  for (int row = 0; row < kRows; ++row) {
    if (random.chance(0.1)) in.f(5, row) = -in.f(5, row);  // wi below the surface
    for (const int c : {6, 7}) in.f(c, row) = random.unit();
    in.f(8, row) = std::pow(10.0f, random.between(-3, 0));
    // Gangs of one material (loaded once) and of several (gathered).
    const int n = static_cast<int>(scene.materials.size());
    in.i(0, row) = row / 64 % 2 == 0 ? row / 64 % n : random.below(n);
  }
}

/// Index, two roughnesses, three numbers in [0,1]: see twin_rich_bsdf. Some are smooth, isotropic, matched.
void fill_rich_bsdf(Columns &in, const Twin &twin, const ToyScene &scene, Random &random) {
  fill_bsdf(in, twin, scene, random);
  for (int row = 0; row < kRows; ++row) {
    if (random.chance(0.1)) in.f(8, row) = 0;
    if (random.chance(0.4)) in.f(5, row) = -in.f(5, row);
    in.f(9, row) = random.chance(0.1) ? 1.00001f : std::exp(random.between(-1, 1));
    in.f(10, row) = std::pow(10.0f, random.between(-3, 0));
    in.f(11, row) = random.chance(0.3) ? in.f(10, row) : std::pow(10.0f, random.between(-3, 0));
    for (const int c : {12, 13, 14}) in.f(c, row) = random.unit();
  }
}

void fill_rays(Columns &in, const Twin &twin, const ToyScene &scene, Random &random) {
  for (int row = 0; row < kRows; ++row) {
    const AimedRay ray = aimed_ray(scene, random, 1);
    in.put(0, row, ray.origin);
    in.put(3, row, ray.direction);
    const int32 hit[] = {ray.hit.geometry, ray.hit.primitive, ray.hit.instance, ray.hit.far_root};
    for (int c = 0; c < 4; ++c) in.i(c, row) = hit[c];
    if (row / 64 % 2 == 0 && row > 0 && row % 64 != 0)  // a gang on one geometry
      for (int c = 0; c < 4; ++c) in.i(c, row) = in.i(c, row - 1);
    if (twin.floats > 6) {
      in.put(6, row, vec3(random.unit(), random.unit(), random.unit()));
      in.f(9, row) = random.chance(0.4) ? 0.0f : random.unit();
    }
    if (twin.ints > 4) {
      in.i(4, row) = random.below(9);
      in.i(5, row) = static_cast<int32>(random.bits());
      in.i(6, row) = random.below(1000);
    }
  }
}

/// Places on surfaces and, in the whole numbers, textures; some rows have none (-1).
void fill_texture_points(Columns &in, const Twin &twin, const ToyScene &scene, Random &random) {
  fill_random(in, twin, random, -3, 3);
  const auto num_textures = static_cast<int>(scene.textures.textures.size());
  const bool may_be_none = std::string(twin.name) != "texture";
  for (int row = 0; row < kRows; ++row)
    for (int c = 0; c < twin.ints; ++c) {
      in.i(c, row) = row / 64 % 2 == 0 ? row / 64 % num_textures : random.below(num_textures);
      if (may_be_none && random.chance(0.1)) in.i(c, row) = -1;
    }
}

/// Inputs that make sense to the function, and some that barely do.
Columns make_inputs(const Twin &twin, const ToyScene &scene) {
  Columns in(twin.floats, twin.ints);
  Random random(99);
  const std::string name = twin.name;
  if (name == "lang" || name == "vectors") {
    fill_random(in, twin, random, -10, 10);
    const float special[] = {std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(), 3e38f, 1e-40f};
    if (name == "lang")  // floor() of these differs in no way that matters: column 2 stays finite
      for (int row = 0; row < 1000; ++row) in.f(random.below(2), row) = special[random.below(5)];
    else
      for (int row = 0; row < 1000; ++row) in.f(random.below(3), row) = special[random.below(5)];
  } else if (name == "sincos") {
    fill_random(in, twin, random, -1, 2);
    for (int row = 0; row < kRows; ++row) in.f(0, row) = std::clamp(in.f(0, row), -1.0f, 2.0f);
  } else if (name == "transcendental") {
    fill_random(in, twin, random, -2, 2);
    for (int row = 0; row < kRows; ++row)  // all magnitudes
      if (random.chance(0.5)) {
        in.f(0, row) *= std::exp2(random.between(-60, 60));
        in.f(1, row) *= std::exp2(random.between(-20, 20));
      }
  } else if (name == "texture" || name == "relief" || name == "textured") {
    fill_texture_points(in, twin, scene, random);
  } else if (name == "noise" || name == "wrap_texels") {
    fill_random(in, twin, random, -5, 5);
    for (int row = 0; row < kRows && name == "wrap_texels"; ++row) {
      in.i(0, row) = 1 + random.below(random.chance(0.5) ? 4 : 1 << 20);
      in.i(1, row) = random.below(3);
      in.i(2, row) = random.below(2);
      if (random.chance(0.1)) in.f(0, row) = std::numeric_limits<float>::quiet_NaN();
    }
  } else if (name == "frame") {
    for (int row = 0; row < kRows; ++row) {
      in.put(0, row, random.chance(0.01) ? vec3(0, -0.0f, -1) : random.direction());
      in.put(3, row, random.direction());
    }
  } else if (name == "affine" || name == "plane") {
    fill_random(in, twin, random, -5, 5);
  } else if (name == "ggx") {
    fill_directions(in, random);
    for (int row = 0; row < kRows; ++row) {
      in.f(6, row) = std::pow(10.0f, random.between(-3, 0));
      in.f(7, row) = random.unit();
      in.f(8, row) = random.unit();
    }
  } else if (name == "diffuse" || name == "mirror" || name == "dielectric" || name == "conductor") {
    fill_bsdf(in, twin, scene, random);
  } else if (twin.floats == 15 && twin.ints == 1) {
    fill_rich_bsdf(in, twin, scene, random);
  } else if (name == "camera" || name == "wide_camera" || name == "light_choice") {
    for (int row = 0; row < kRows; ++row) {
      for (int c = 0; c < twin.floats; ++c)
        in.f(c, row) = random.chance(0.05) ? 1 - 0x1p-24f : random.unit();
      for (int c = 0; c < twin.ints; ++c) in.i(c, row) = static_cast<int32>(random.bits());
    }
  } else if (name == "light_sample" || name == "light_density" || name == "rich_light_sample" ||
             name == "rich_light_density") {
    for (int row = 0; row < kRows; ++row) {
      in.put(0, row, random.point(4));
      for (int c = 3; c < twin.floats; ++c) in.f(c, row) = random.unit();
      if (twin.floats > 7) in.put(6, row, random.direction());
      if (twin.ints > 0) in.i(0, row) = row / 64 % 2 == 0 ? row / 64 : random.below(1000);
    }
  } else if (name == "infinite_light" || name == "solid_angle") {
    for (int row = 0; row < kRows; ++row) {
      for (int c = 0; c < twin.floats; ++c)
        in.f(c, row) = random.chance(0.05) ? edge_value(random) : random.unit();
      in.put(0, row, name == "solid_angle" ? random.point(2) : random.direction());
      if (name == "solid_angle") in.put(3, row, random.direction());
    }
  } else if (name == "sphere" || name == "disk") {
    fill_random(in, twin, random, -3, 3);
    for (int row = 0; row < kRows; ++row) {
      const int bounds = twin.floats - 2;
      in.f(bounds, row) = random.chance(0.5) ? PHALANX_NEAR : random.unit();
      in.f(bounds + 1, row) = random.chance(0.5) ? PHALANX_FAR : random.between(0, 10);
      if (name == "disk") in.i(0, row) = random.below(static_cast<int>(scene.disks.size()));
      if (name == "sphere") in.f(9, row) = std::fabs(in.f(9, row)) + 1e-3f;
    }
  } else if (twin.ints >= 4 && twin.floats >= 6) {
    fill_rays(in, twin, scene, random);
  } else {  // uniforms, cosines, indices
    fill_random(in, twin, random, 0, 1);
    if (name == "warps" || name == "fresnel")
      for (int row = 0; row < kRows; ++row)
        for (int c = 0; c < twin.floats; ++c)
          in.f(c, row) = std::clamp(std::fabs(in.f(c, row)), c == 1 ? 1e-3f : 1e-9f, 1 - 0x1p-24f);
    if (name == "fresnel")
      for (int row = 0; row < kRows; ++row)
        for (const int c : {1, 2}) in.f(c, row) = std::exp(random.between(-9, 9));
  }
  return in;
}

/// Compares `results` columns row by row; returns how many values differ and says which is the first.
int differences(const Twin &twin, const Columns &in, const std::vector<float> &vector,
                const SceneView &scene, const FrameView &frame, std::string &first) {
  int differing = 0;
  for (int row = 0; row < kRows; ++row) {
    TwinIn input = {};
    for (int c = 0; c < twin.floats; ++c) input.f[c] = in.floats()[c * kRows + row];
    for (int c = 0; c < twin.ints; ++c) input.i[c] = in.ints()[c * kRows + row];
    const TwinOut expected = twin.scalar(scene, frame, input);
    for (int c = 0; c < twin.results; ++c) {
      const float got = vector[static_cast<std::size_t>(c * kRows + row)];
      if (same(got, expected.f[c])) continue;
      if (differing++ == 0)
        first = "row " + std::to_string(row) + ", result " + std::to_string(c) + ": C++ " +
                std::to_string(expected.f[c]) + ", ISPC " + std::to_string(got);
    }
  }
  return differing;
}

/// What the scalar function returns is worth comparing only where it is mostly defined.
double share_of_nan(const Twin &twin, const std::vector<float> &results) {
  double nan = 0;
  for (const float value : results) nan += std::isnan(value);
  return nan / (static_cast<double>(twin.results) * kRows);
}

/// Runs a twin on every instruction set that is there.
void check_twin(const Twin &twin, const ToyScene &scene, const SceneView &view,
                const FrameView &frame) {
  const Columns in = make_inputs(twin, scene);
  const char *const isas[] = {"sse4", "avx2", "avx512skx"};
  for (std::size_t k = 0; k < std::size(isas); ++k) {
    if (twin.kernels[k] == nullptr || !isa_supported(isas[k])) continue;
    std::vector<float> results(static_cast<std::size_t>(twin.results) * kRows, -12345.0f);
    twin.kernels[k](&view, &frame, in.floats(), in.ints(), results.data(), kRows);
    std::string first;
    const int differing = differences(twin, in, results, view, frame, first);
    CAPTURE(std::string(twin.name));
    CAPTURE(std::string(isas[k]));
    CAPTURE(first);
    CHECK(differing == 0);
    const bool bits = std::string(twin.name) == "hashes";  // any bits may come back
    if (!bits) CHECK(share_of_nan(twin, results) < 0.2);
  }
}

}  // namespace

#ifdef PHALANX_FAST
constexpr bool kExact = false;  // contraction into FMA gives up these bits
#else
constexpr bool kExact = true;
#endif

TEST_CASE("twin: every physics function gives the same bits in C++ and in ISPC" *
          doctest::skip(!kExact)) {
  const ToyScene scene = random_scene(123, 1);
  const SceneView view = scene.view();
  const FlushDenormals flush;
  for (const int32 sampler : {kSobolSampler, kIndependentSampler}) {
    FrameView frame = scene.frame();
    frame.sampler = sampler;
    if (sampler == kIndependentSampler) frame.camera.lens_radius = 0;
    for (const Twin &twin : kTwins) check_twin(twin, scene, view, frame);
  }
}

TEST_CASE("twin: other samplers and cameras" * doctest::skip(!kExact)) {
  const ToyScene scene = random_scene(123, 1);
  const SceneView view = scene.view();
  const FlushDenormals flush;
  for (const int32 kind : {kPerspective, kOrthographic, kEquirectangular, kFisheye}) {
    FrameView frame = scene.frame();
    frame.sampler = kStratifiedSampler + kind % 3;
    frame.spp = kind == kFisheye ? 60 : 64;
    frame.camera.kind = kind;
    frame.camera.half_height = 2.5f;
    frame.camera.half_angle_turns = 0.3f;
    frame.camera.blades = 5;
    frame.camera.blade_turns = 0.1f;
    for (const Twin &twin : kTwins)
      for (const char *name : {"sample_pair", "samplers", "camera", "wide_camera", "start_path"})
        if (std::string(twin.name) == name) check_twin(twin, scene, view, frame);
  }
}

TEST_CASE("twin: lights of every kind, chosen by a table and by a tree" * doctest::skip(!kExact)) {
  const ToyScene toy = random_scene(123, 1);
  const FrameView frame = toy.frame();
  const FlushDenormals flush;
  for (const bool tree : {false, true}) {
    const Scene scene = any_lights(123, tree);
    const SceneView view = scene.view();
    for (const Twin &twin : kTwins)
      for (const char *name : {"rich_light_sample", "rich_light_density", "infinite_light"})
        if (std::string(twin.name) == name) check_twin(twin, toy, view, frame);
  }
}
