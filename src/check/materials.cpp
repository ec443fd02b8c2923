// Materials at the ends of their ranges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "any_bsdf.h"
#include "case.h"
#include "groups.h"
#include "normal_space.h"
#include "random.h"
#include "statistics.h"

namespace phalanx::check {
namespace {

/// Least p-value of one of the suite's fits: some 50 of them raise a false alarm once in 2000 sets of seeds.
constexpr double kLeastP = 1e-5;

Vec3 direction_at(double cosine, double phi = 0.7) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
          static_cast<float>(cosine)};
}

/// A built material with the tables it needs.
struct Built {
  Stage stage;
  Built(const Case &c, const std::string &type, const std::string &keys) : stage(c.stage(scene_of(type, keys))) {}
  static SceneText scene_of(const std::string &type, const std::string &keys) {
    SceneText scene;
    scene.materials = {material("m", type, keys)};
    scene.shapes = {sphere("m", {0, 0, 0}, 1)};
    return scene;
  }
  const Material &m() const { return stage.scene().materials.back(); }
  SceneView view() const { return stage.scene().view(); }
};

SceneText ball_under_the_sky(const std::string &of_material) {
  SceneText scene;
  scene.camera = camera({0, 0, 5}, {0, 0, 0}, 20, {0, 1, 0});
  scene.lights = {kSky};
  scene.materials = {of_material};
  scene.shapes = {sphere("m", {0, 0, 0}, 1)};
  return scene;
}

// ---- microfacets --------------------------------------------------------------------------------

template <typename Alpha>
Fit fit_of_normals(Alpha alpha, const NormalSpace &space, Vec3 wo, int samples) {
  Random random(17);
  Histogram histogram(hemisphere_grid(10, 20));
  for (int i = 0; i < samples; ++i) {
    const NormalSpace::Place at = space.place(sample_ggx_visible(wo, alpha, random.square()));
    histogram.add(at.cosine, at.phi);
  }
  return chi_square_fit(histogram, cell_masses(histogram.grid(), [&](double cosine, double phi) {
                          const NormalSpace::Normal n = space.normal(cosine, phi);
                          return static_cast<double>(pdf_ggx_visible(wo, n.direction, alpha)) * n.jacobian;
                        }));
}

void sharp_and_rough_microfacets(Case &c) {
  const int samples = c.count(100000, 2000000);
  for (const double cosine : {1.0, 0.5, 0.1, 1e-3}) {
    const Vec3 wo = direction_at(cosine);
    for (const float alpha : {5e-3f, 1e-2f, 0.1f, 1.0f})
      c.within(fmt::format("chi-square p of normals, alpha = {:g}, cos = {:g}", alpha, cosine),
               fit_of_normals(alpha, {static_cast<double>(alpha)}, wo, samples).p, kLeastP, 1);
    const Vec2 brushed = {1e-2f, 1};
    c.within(fmt::format("chi-square p of normals, alpha = (0.01, 1), cos = {:g}", cosine),
             fit_of_normals(brushed, {static_cast<double>(1e-2f), 1}, wo, samples).p, kLeastP, 1);
  }
  // The density itself, against the same formula with more digits.
  Random random(2);
  for (const float alpha : {1e-4f, 1e-3f, 1e-2f}) {
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
      const Vec3 m = normalize(vec3(alpha * random.between(-3, 3), alpha * random.between(-3, 3), 1));
      const long double a2 = static_cast<long double>(alpha) * static_cast<long double>(alpha);
      const long double x = m.x, y = m.y, z2 = 1 - x * x - y * y, t = x * x + y * y + a2 * z2;
      const auto exact = static_cast<double>(a2 / (3.14159265358979323846L * t * t));
      worst = std::fmax(worst, relative_error(static_cast<double>(ggx_d(m, alpha)), exact));
    }
    c.at_most(fmt::format("relative error of the density of normals, alpha = {:g}", alpha), worst, 1e-5);
  }
  for (const char *alpha : {"0", "1e-8", "1e-4"}) {
    c.equal(fmt::format("kind of a conductor of alpha {} (a mirror)", alpha),
            Built(c, "conductor", fmt::format(R"("alpha": {})", alpha)).m().kind, kMirror);
    c.radiance(fmt::format("white conductor of alpha {} under a white sky", alpha),
               ball_under_the_sky(material("m", "conductor", fmt::format(R"("reflectance": 1, "alpha": {})", alpha))), 64, 1);
  }
  for (const char *alpha : {"1e-3", "1e-2", "0.1", "1"})
    c.bounded_radiance(fmt::format("white conductor of alpha {} under a white sky", alpha),
                       ball_under_the_sky(material("m", "conductor", fmt::format(R"("reflectance": 1, "alpha": {})", alpha))),
                       256, 0.3, 1.0001);
  // The sharpest metal reflects what a mirror does.
  Stage mirror = c.stage(ball_under_the_sky(material("m", "mirror", R"("reflectance": 0.5)")));
  const double reflected = measure(c.film(mirror, 1024, c.isas().back())).mean;
  c.radiance("conductor of alpha 1e-3 against a mirror", ball_under_the_sky(material("m", "conductor", R"("reflectance": 0.5, "alpha": 1e-3)")),
             1024, reflected, 1e-3);
}

void visible_normals(Case &c) {
  for (const char *alpha : {"1e-3", "0.1", "1"}) {
    const Built metal(c, "conductor", fmt::format(R"("reflectance": 1, "alpha": {})", alpha));
    for (const double cosine : {1.0, 1e-3, 1e-7}) {
      Random random(3);
      float lo = 1, hi = 0;
      std::int64_t bad = 0;
      for (int i = 0; i < c.count(10000, 200000); ++i) {
        const BsdfSample s = sample_any(metal.view(), metal.m(), 1, direction_at(cosine), random.square(), random.unit());
        bad += !all_finite(s.weight) || !is_finite(s.pdf) || !(std::fabs(length(s.wi) - 1) < 1e-6f);
        lo = min_of(lo, s.weight.y);
        hi = max_of(hi, s.weight.y);
      }
      const std::string what = fmt::format("alpha = {}, cos = {:g}", alpha, cosine);
      c.equal(what + ": samples that are not finite or not unit", static_cast<double>(bad), 0);
      c.within(what + ": least weight", static_cast<double>(lo), 0, 1);
      c.within(what + ": largest weight", static_cast<double>(hi), 0, 1.000001);
    }
  }
}

// ---- interfaces ---------------------------------------------------------------------------------

void index_of_one(Case &c) {
  for (const char *ior : {"1", "1.0000001", "0.9999999"})
    for (const char *alpha : {"0", "0.3"}) {
      const Built glass(c, "dielectric", fmt::format(R"("ior": {}, "alpha": {})", ior, alpha));
      Random random(4);
      std::int64_t bent = 0, weighted = 0;
      for (int i = 0; i < 20000; ++i) {
        Vec3 wo = random.direction();
        wo.z = max_of(abs_of(wo.z), 1e-4f);
        wo = normalize(wo);
        const BsdfSample s = sample_any(glass.view(), glass.m(), i & 1, wo, random.square(), random.unit());
        bent += !(length(s.wi + wo) <= 1e-6f);
        weighted += !(std::fabs(s.weight.y - 1) <= 1e-6f) || s.pdf != 0;
      }
      c.equal(fmt::format("ior {}, alpha {}: directions that are bent", ior, alpha), static_cast<double>(bent), 0);
      c.equal(fmt::format("ior {}, alpha {}: weights other than 1", ior, alpha), static_cast<double>(weighted), 0);
      SceneText scene;
      scene.materials = {material("glass", "dielectric", fmt::format(R"("ior": {}, "alpha": {})", ior, alpha))};
      scene.shapes = {level("grey", 1, 0), level("lamp", 1, 1, true),
                      fmt::format(R"({{"type": "box", "material": "glass", "lo": [-3, 0.6, -3], "hi": [3, 0.8, 3]}})")};
      c.radiance(fmt::format("lamp seen through a slab of ior {}, alpha {}", ior, alpha), scene, 65536,
                 0.5 / kPi * rectangle_irradiance(-1, 1, -1, 1, 1), 1e-4);
    }
}

void extreme_indices(Case &c) {
  double lo = 1, hi = 0;
  for (const float eta : {100.0f, 1e4f, 0.01f, 1e-4f})
    for (int i = 0; i <= 1000; ++i) {
      const auto r = static_cast<double>(fresnel_dielectric(static_cast<float>(i) * 1e-3f, eta).reflectance);
      lo = std::fmin(lo, std::isnan(r) ? -1 : r);
      hi = std::fmax(hi, std::isnan(r) ? 2 : r);
    }
  c.within("least reflectance of indices 1e-4 to 1e4", lo, 0, 1);
  c.within("largest reflectance of indices 1e-4 to 1e4", hi, 0, 1);
  for (const float eta : {100.0f, 1e4f}) {
    const double n = static_cast<double>(eta), r = (n - 1) / (n + 1);
    c.near(fmt::format("reflectance of index {:g} along the normal", eta),
           static_cast<double>(fresnel_dielectric(1, eta).reflectance), r * r, 1e-6);
  }
  for (const auto &[eta, k] : {std::pair{0.01f, 1e4f}, {1.0f, 1e4f}, {0.01f, 0.0f}, {10.0f, 10.0f}}) {
    double least = 1, largest = 0;
    for (int i = 0; i <= 1000; ++i) {
      const auto r = static_cast<double>(fresnel_conductor(static_cast<float>(i) * 1e-3f, eta, k));
      least = std::fmin(least, std::isnan(r) ? -1 : r);
      largest = std::fmax(largest, std::isnan(r) ? 2 : r);
    }
    c.within(fmt::format("least reflectance of {:g} + {:g} i", eta, k), least, 0, 1);
    c.within(fmt::format("largest reflectance of {:g} + {:g} i", eta, k), largest, 0, 1);
  }
  c.near("reflectance of 1 + 1e4 i along the normal", static_cast<double>(fresnel_conductor(1, 1, 1e4f)), 0.99999996, 1e-6);
  for (const char *ior : {"100", "1e4"})
    c.radiance(fmt::format("ball of ior {} under a white sky", ior),
               [&] {
                 SceneText scene = ball_under_the_sky(material("m", "dielectric", fmt::format(R"("ior": {})", ior)));
                 scene.integrator = R"("max_depth": 100000, "roulette_depth": 100000)";
                 // Light that got in leaves with a probability of 4 / ior: seen in the mirror alone it takes no time.
                 scene.shapes = {quad("m", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), quad("black", {-9, -9, -1}, {18, 0, 0}, {0, 18, 0})};
                 return scene;
               }(),
               4096, [&] {
                 const double n = std::stod(ior), r = (n - 1) / (n + 1);
                 return r * r;
               }(), 1e-3);
}

void total_reflection(Case &c) {
  const float eta = 1 / 1.5f;
  const auto cosine_at = [](double factor) {
    const double sine = factor / 1.5;
    return static_cast<float>(std::sqrt(1 - sine * sine));
  };
  std::int64_t partial = 0;
  for (const double above : {1e-6, 1e-5, 1e-3, 0.1}) partial += fresnel_dielectric(cosine_at(1 + above), eta).reflectance != 1;
  c.equal("angles above the critical one that do not reflect everything", static_cast<double>(partial), 0);
  for (const double below : {1e-6, 1e-4, 1e-2}) {
    const double cos_i = static_cast<double>(cosine_at(1 - below)), n = static_cast<double>(eta);
    const double cos_t = std::sqrt(1 - (1 - cos_i * cos_i) / (n * n));
    const double p = (n * cos_i - cos_t) / (n * cos_i + cos_t), s = (cos_i - n * cos_t) / (cos_i + n * cos_t);
    c.near(fmt::format("reflectance {:g} below the critical angle", below),
           static_cast<double>(fresnel_dielectric(cosine_at(1 - below), eta).reflectance), 0.5 * (p * p + s * s),
           below < 1e-5 ? 1e-3 : 1e-4);
  }
  const Built glass(c, "dielectric", R"("ior": 1.5)");
  Random random(5);
  std::int64_t bad = 0;
  for (int i = 0; i < 100000; ++i) {
    const double off = (random.fine() * 2 - 1) * (i % 2 == 0 ? 1e-7 : 1e-5);
    const double sine = (1 + off) / 1.5;
    const Vec3 wo = direction_at(std::sqrt(1 - sine * sine), random.fine() * 6.28);
    const BsdfSample s = sample_any(glass.view(), glass.m(), 0, wo, random.square(), random.unit());
    bad += !(std::fabs(length(s.wi) - 1) <= 1e-6f) || !all_finite(s.weight) || s.wi.z == 0;
  }
  c.equal("directions at the critical angle that are not unit", static_cast<double>(bad), 0);
}

// ---- energy -------------------------------------------------------------------------------------

void albedo_one(Case &c) {
  SceneText scene;
  scene.width = scene.height = 4;
  scene.camera = camera({0.1, 0.2, 0.3}, {1, 0, 0}, 60, {0, 1, 0});
  scene.materials = {material("walls", "diffuse", R"("reflectance": 1, "emission": 1, "two_sided": true)")};
  scene.shapes = {R"({"type": "box", "material": "walls"})"};
  scene.integrator = R"("max_depth": 10000, "roulette_depth": 10000)";
  // Light sampling and scattering share every light by their weights, so that there is noise.
  c.radiance("closed box of albedo 1 and radiance 1, 10^4 bounces", scene, 256, 10001, 6e-4);
  scene.materials = {material("walls", "diffuse", R"("reflectance": 0.999, "emission": 1, "two_sided": true)")};
  scene.shapes = {sphere("walls", {0, 0, 0}, 1)};
  scene.integrator = R"("max_depth": 20000, "roulette_depth": 20000)";
  c.radiance("integrating sphere of albedo 0.999", scene, 256, 1 / (1 - static_cast<double>(0.999f)), 2e-4);
  // A mirror keeps everything.
  scene.materials = {material("walls", "mirror", R"("reflectance": 0.9, "emission": 1, "two_sided": true)")};
  scene.shapes = {sphere("walls", {0, 0, 0}, 1)};
  scene.camera = camera({0, 0, 0}, {1, 0, 0}, 1, {0, 1, 0});
  scene.integrator = R"("max_depth": 1000, "roulette_depth": 1000)";
  c.exact_radiance("mirror ball of reflectance 0.9 seen from its middle", scene, 10, 1e-4);
}

void impossible_albedos(Case &c) {
  for (const char *type : {"diffuse", "mirror", "conductor", "rough_diffuse", "coated_diffuse"})
    for (const char *value : {"1.5", "-0.1", "1e999", "null", "\"NaN\"", "[0.5, 0.5, 2]"})
      c.rejects(fmt::format("{} of reflectance {}", type, value),
                fmt::format(R"({{"version": 1, "materials": [{{"name": "m", "type": "{}", "reflectance": {}}}]}})", type, value),
                "/materials/0/reflectance");
}

void nothing_but_black(Case &c) {
  for (const char *of : {R"({"name": "m", "type": "black"})", R"({"name": "m", "type": "diffuse", "reflectance": 0})"}) {
    SceneText scene = ball_under_the_sky(of);
    scene.camera = camera({0, 0, 5}, {0, 0, 0}, 5, {0, 1, 0});
    scene.integrator = R"("max_depth": 64, "roulette_depth": 1)";
    c.exact_radiance(fmt::format("inside the outline: {}", of), scene, 0);
    Stage stage = c.stage(scene);
    for (const std::string &isa : c.isas()) {
      RenderOptions options;
      options.isa = isa;
      options.spp = 16;
      options.mode = c.mode();
      const RunStats stats = c.render(stage, options).stats;
      c.equal(with_isa(c, fmt::format("rays after the first hit: {}", of), isa),
              static_cast<double>(stats.rays.bounce + stats.rays.shadow), 0);
    }
  }
}

struct White {
  const char *what, *type, *keys;
  bool conserves;  // within 0.5 %
};
const White kWhites[] = {
    {"diffuse", "diffuse", R"("reflectance": 1)", true},
    {"rough_diffuse, roughness 1", "rough_diffuse", R"("reflectance": 1, "roughness": 1)", true},
    {"mirror", "mirror", R"("reflectance": 1)", true},
    {"dielectric", "dielectric", R"("ior": 1.5)", true},
    {"thin_dielectric", "thin_dielectric", R"("ior": 1.5)", true},
    {"conductor, alpha 0.1", "conductor", R"("reflectance": 1, "alpha": 0.1)", false},
    {"conductor, alpha 0.5", "conductor", R"("reflectance": 1, "alpha": 0.5)", false},
    {"conductor, alpha 1", "conductor", R"("reflectance": 1, "alpha": 1)", false},
    {"compensated conductor, alpha 0.1", "conductor", R"("reflectance": 1, "alpha": 0.1, "multiple_scattering": true)", true},
    {"compensated conductor, alpha 0.5", "conductor", R"("reflectance": 1, "alpha": 0.5, "multiple_scattering": true)", true},
    {"compensated conductor, alpha 1", "conductor", R"("reflectance": 1, "alpha": 1, "multiple_scattering": true)", true},
    {"rough dielectric, alpha 0.1", "dielectric", R"("ior": 1.5, "alpha": 0.1)", false},
    {"rough dielectric, alpha 0.5", "dielectric", R"("ior": 1.5, "alpha": 0.5)", false},
    {"coated_diffuse, smooth", "coated_diffuse", R"("reflectance": 1)", false},
    {"coated_diffuse, alpha 0.3", "coated_diffuse", R"("reflectance": 1, "alpha": 0.3)", false},
    {"principled plastic", "principled", R"("base_color": 1, "roughness": 0.4)", false},
    {"principled metal", "principled", R"("base_color": 1, "metallic": 1, "roughness": 0.6)", false},
    {"principled glass", "principled", R"("base_color": 1, "transmission": 1, "roughness": 0.4)", false},
    {"principled, coat and sheen", "principled", R"("base_color": 1, "clearcoat": 1, "clearcoat_roughness": 0.6, "sheen_color": 1)", false},
    {"phong, exponent 10", "phong", R"("reflectance": 1, "exponent": 10)", false},
    {"blinn_phong, exponent 10", "blinn_phong", R"("reflectance": 1, "exponent": 10)", false},
};

void white_furnaces(Case &c) {
  const int samples = c.count(20000, 400000);
  for (const White &white : kWhites) {
    const Built built(c, white.type, white.keys);
    for (const double cosine : {1.0, 0.9, 0.5, 0.1, 0.02}) {
      Random random(23);
      Mean energy;
      const Vec3 wo = direction_at(cosine);
      for (int i = 0; i < samples; ++i) {
        const BsdfSample s = sample_any(built.view(), built.m(), 1, wo, random.square(), random.unit());
        const double eta = index_step(built.m(), 1, wo, s.wi);
        energy.add(static_cast<double>(s.weight.y) * eta * eta);
      }
      const double noise = 4 * energy.standard_error() + 1e-5;
      const std::string what = fmt::format("energy of {}, cos = {:g}", white.what, cosine);
      if (white.conserves) c.within(what, energy.mean(), 0.995 - noise, 1.005 + noise);
      else c.within(what, energy.mean(), 0.1, 1 + noise);
      if (std::string(white.what) == "conductor, alpha 1" && cosine == 1)
        c.near("the same, against 1 - ln 2", energy.mean(), 1 - std::log(2.0), noise);
    }
  }
}

void reciprocity(Case &c) {
  for (const White &white : kWhites) {
    const std::string type = white.type;
    if (type == "phong" || type == "blinn_phong" || type == "mirror" || type == "thin_dielectric") continue;
    const Built built(c, white.type, white.keys);
    const Material &m = built.m();
    if (m.kind == kDielectric) continue;  // a delta
    Random random(2);
    double worst = 0;
    for (int i = 0; i < c.count(10000, 100000); ++i) {
      Vec3 wo = random.direction(), wi = random.direction();
      wo.z = max_of(abs_of(wo.z), 1e-3f);
      wi.z = max_of(abs_of(wi.z), 1e-3f);
      wo = normalize(wo);
      wi = normalize(wi);
      const auto f = [&](int32 front, Vec3 from, Vec3 to) {
        return static_cast<double>(eval_any(built.view(), m, front, from, to).f_cos.y / abs_of(to.z));
      };
      const double there = f(1, wo, wi), back = f(1, wi, wo);
      if (back > 0) worst = std::fmax(worst, std::fabs(there - back) / back);
      if (m.kind != kRoughDielectric && m.kind != kPrincipled) continue;
      // Through the surface, from the other side the frame is upside down. Near total reflection what gets through
      // is the small difference of numbers near 1: relative to 0.01 at least.
      const Vec3 below = {wi.x, wi.y, -wi.z}, above = {wo.x, wo.y, -wo.z};
      const double eta2 = static_cast<double>(m.ior) * static_cast<double>(m.ior);
      const double in = f(1, wo, below) * eta2, out = f(0, wi, above);
      worst = std::fmax(worst, std::fabs(in - out) / std::fmax(out, 0.01));
    }
    c.at_most(fmt::format("worst relative asymmetry of {}", white.what), worst, 1e-4);
  }
}

void densities_integrate_to_one(Case &c) {
  for (const White &white : kWhites) {
    const Built built(c, white.type, white.keys);
    const Material &m = built.m();
    if (m.kind == kMirror || m.kind == kDielectric || m.kind == kThinDielectric) continue;
    if (m.alpha < 0.3f && (m.kind == kConductor || m.kind == kGlossyConductor || m.kind == kRoughDielectric)) continue;
    for (const double cosine : {1.0, 0.5, 0.1}) {
      const Vec3 wo = direction_at(cosine);
      double mass = 0;
      // By the root of the cosine, with its sign: fine at the horizon.
      for (const double part : cell_masses(sphere_grid(32, 64), [&](double root, double phi) {
             const double size = std::fabs(root);
             return static_cast<double>(eval_any(built.view(), m, 1, wo, direction_at(root * size, phi)).pdf) * 2 * size;
           }))
        mass += part;
      Random random(7);
      const int samples = c.count(50000, 1000000);
      std::int64_t valid = 0;
      for (int i = 0; i < samples; ++i)
        valid += sample_any(built.view(), m, 1, wo, random.square(), random.unit()).pdf > 0;
      const double share = static_cast<double>(valid) / samples;
      c.near(fmt::format("integral of the density of {}, cos = {:g}, against the share of valid samples", white.what, cosine),
             mass, share, 1e-3 + 5 * std::sqrt(share * (1 - share) / samples));
    }
  }
}

// ---- put together -------------------------------------------------------------------------------

void blends_at_their_ends(Case &c) {
  const auto blended = [](const char *weight) {
    SceneText scene = ball_under_the_sky(material("a", "rough_diffuse", R"("reflectance": 0.3)"));
    // Textured, so that alone, too, it runs the kernels with everything.
    scene.textures = {R"({"name": "t", "type": "constant", "colour": 0.8})"};
    scene.materials.push_back(material("b", "conductor", R"("reflectance": "t", "alpha": 0.3)"));
    scene.materials.push_back(weight[0] == 'a' || weight[0] == 'b'
                                  ? material("unused", "black")
                                  : material("m", "blend", fmt::format(R"("a": "a", "b": "b", "weight": {})", weight)));
    scene.shapes = {sphere(weight[0] == 'a' || weight[0] == 'b' ? weight : "m", {0, 0, 0}, 1)};
    return scene;
  };
  c.same_bits("a blend of weight 0 and its first part", blended("0"), blended("a"));
  c.same_bits("a blend of weight 1 and its second part", blended("1"), blended("b"));
  for (const char *weight : {"-0.1", "1.1", "1e999"}) c.rejects(fmt::format("weight {}", weight), blended(weight).text(), "weight");
  c.rejects("a blend of itself",
            R"({"version": 1, "materials": [{"name": "a", "type": "blend", "a": "b", "b": "b"}, {"name": "b", "type": "blend", "a": "a", "b": "a"}]})",
            "/materials");
}

void broken_normal_maps(Case &c) {
  for (const char *colour : {"[0, 0, 0]", "[0.5, 0.5, 0.5]", "[0.5, 0.5, 0]", "[1, 0.5, 0.5]", "[1, 1, 1]", "[0, 0, 1]"})
    for (const char *type : {"diffuse", "conductor", "dielectric"}) {
      SceneText scene = ball_under_the_sky(
          material("m", type, std::string(R"("normal_map": "map")") +
                                  (type[0] == 'd' && type[2] == 'e' ? "" : R"(, "reflectance": 1)")));
      scene.textures = {fmt::format(R"({{"name": "map", "type": "constant", "colour": {}}})", colour)};
      c.bounded_radiance(fmt::format("{} with the map {} everywhere", type, colour), scene, 256, 0.02, 1.001);
    }
}

void glass_in_glass(Case &c) {
  SceneText scene = ball_under_the_sky(material("m", "dielectric", R"("ior": 1.5)"));
  scene.materials.push_back(material("heavy", "dielectric", R"("ior": 1.9)"));
  scene.integrator = R"("max_depth": 5000, "roulette_depth": 5000)";
  scene.shapes = {sphere("m", {0, 0, 0}, 1), sphere("heavy", {0.2, 0.1, 0}, 0.5)};
  c.radiance("glass in glass under a white sky", scene, 4096, 1, 1e-3);
  scene.shapes = {sphere("m", {-0.3, 0, 0}, 0.8), sphere("heavy", {0.4, 0, 0}, 0.7)};
  c.bounded_radiance("overlapping glass under a white sky", scene, 1024, 0.2, 4);
  scene.shapes = {sphere("m", {0, 0, 0}, 1)};
  scene.camera = camera({0.1, 0.2, 0}, {0, 0, -1}, 60, {0, 1, 0});
  c.radiance("camera in glass under a white sky: the square of the index", scene, 256, 2.25, 1e-4);

  // A slab of index 1.5 that reflects between its faces: R = 2 r / (1 + r), without polarisation.
  const auto slab = [](double degrees, bool transmitted) {
    SceneText s;
    const double a = degrees * kPi / 180;
    s.camera = camera({-3 * std::sin(a), 3 * std::cos(a), 0}, {0, 0, 0}, 1e-3);
    s.materials = {material("m", "dielectric", R"("ior": 1.5)")};
    s.lights = {kSky};
    s.shapes = {R"({"type": "box", "material": "m", "lo": [-1e3, -0.1, -1e3], "hi": [1e3, 0, 1e3]})",
                transmitted ? level("black", 1e5, 10, true) : level("black", 1e5, -10)};
    return s;
  };
  c.radiance("reflected by a slab at 0 degrees", slab(0, false), 262144, 1.0 / 13, 1e-4);
  c.radiance("transmitted by a slab at 0 degrees", slab(0, true), 16384, 12.0 / 13, 1e-4);
  c.radiance("reflected by a slab at 60 degrees", slab(60, false), 131072, 0.163768, 1e-4);
  c.radiance("transmitted by a slab at 75 degrees", slab(75, true), 32768, 0.596092, 1e-4);
}

void ten_thousand_sheets(Case &c) {
  const auto behind = [](int count, const char *opacity) {
    SceneText scene;
    scene.camera = camera({0, 0, 1}, {0, 0, 0}, 1e-3, {0, 1, 0});
    scene.lights = {kSky};
    scene.materials = {material("sheet", "black", fmt::format(R"("opacity": {})", opacity))};
    for (int i = 0; i < count; ++i) scene.shapes.push_back(quad("sheet", {-1, -1, -1e-3 * i}, {2, 0, 0}, {0, 2, 0}));
    return scene;
  };
  const auto passes = [](int count, float opacity) { return std::pow(1 - static_cast<double>(opacity), count); };
  c.rough_radiance("behind 100 sheets of opacity 0.01", behind(100, "0.01"), 4096, passes(100, 0.01f));
  c.rough_radiance("behind 1000 sheets of opacity 0.001", behind(1000, "0.001"), 512, passes(1000, 0.001f));
  if (!c.quick()) {
    c.rough_radiance("behind 10^4 sheets of opacity 1e-4", behind(10000, "1e-4"), 32, passes(10000, 1e-4f));
    c.rough_radiance("behind 10^4 sheets of opacity 1e-3", behind(10000, "1e-3"), 2048, passes(10000, 1e-3f));
  } else {
    c.remark("10^4 sheets are left out under --quick");
  }
  c.exact_radiance("behind one sheet of opacity 1", behind(1, "1"), 0);
  c.same_bits("1000 sheets of opacity 0 and none", behind(1000, "0"), behind(0, "0"));
}

}  // namespace

Group materials_group() {
  return {"materials",
          {{"M1", "microfacets from perfectly smooth to alpha = 1", sharp_and_rough_microfacets},
           {"M2", "visible normals at grazing angles", visible_normals},
           {"M3", "index of refraction of 1, and next to it", index_of_one},
           {"M4", "extreme indices of refraction", extreme_indices},
           {"M5", "the critical angle", total_reflection},
           {"M6", "albedo of 1 through 10^4 bounces", albedo_one},
           {"M7", "albedos that cannot be", impossible_albedos},
           {"M8", "nothing but black", nothing_but_black},
           {"M9", "white furnaces: no material makes light", white_furnaces},
           {"M10", "reciprocity", reciprocity},
           {"M11", "densities integrate to what is sampled", densities_integrate_to_one},
           {"M12", "blends of weight 0 and 1, and of themselves", blends_at_their_ends},
           {"M13", "normal maps without direction or facing away", broken_normal_maps},
           {"M14", "glass in glass, overlapping glass, camera in glass", glass_in_glass},
           {"M15", "10^4 nearly transparent sheets", ten_thousand_sheets}}};
}

}  // namespace phalanx::check
