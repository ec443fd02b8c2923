// Error against run time: figures of runs whose errors are known.
#include "report/convergence.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "report/error_map.h"
#include "support/statistics.h"

using namespace phalanx;
using phalanx::test::relative_error;
using Json = nlohmann::json;

namespace {

constexpr int kSide = 64;

/// A gradient with Gaussian noise of relative standard deviation `sigma`, times `scale`.
Image noisy(unsigned seed, double sigma, double scale = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, sigma);
  Image image = make_image(kSide, kSide);
  for (const char *name : {"R", "G", "B"}) {
    std::vector<float> &plane = add_channel(image, name);
    for (std::size_t i = 0; i < plane.size(); ++i)
      plane[i] = static_cast<float>((1 + double(i % kSide) / kSide) * scale * (1 + normal(random)));
  }
  return image;
}

ReferencePair reference_of(const Image &a, const Image &b) {
  ReferencePair pair{a, b, noisy(0, 0), "", 1000, true};
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < pair.mean.channels[0].values.size(); ++i)
      pair.mean.channels[static_cast<std::size_t>(c)].values[i] =
          0.5f * (a.channels[static_cast<std::size_t>(c)].values[i] +
                  b.channels[static_cast<std::size_t>(c)].values[i]);
  return pair;
}

/// Runs with relMSE 0.1 t^slope after t = `speed` * 1, 2, 4 ... seconds, with a scatter of 5 %.
Curve power_law(double speed, double slope, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 0.05);
  Curve curve;
  curve.sampler = "sobol";
  for (int run = 0; run < 16; ++run) {
    std::vector<RunPoint> points;
    for (int k = 0; k < 6; ++k) {
      RunPoint p;
      p.spp = 16 << k;
      p.samples_per_pixel = p.spp;
      p.wall_s = std::ldexp(1.0, k) * speed;
      p.error.relmse = 0.1 * std::pow(std::ldexp(1.0, k), slope) * std::exp(normal(random));
      p.flip = p.estimate = p.lo95 = p.hi95 = NAN;
      points.push_back(p);
    }
    curve.runs.push_back(points);
  }
  return curve;
}

}  // namespace

TEST_CASE("picture error: the product of two halves has no share of their noise, one reference has") {
  const double sigma = 0.1, of_reference = 0.05;
  double crossed = 0, plain = 0;
  for (unsigned i = 0; i < 20; ++i) {
    const Image a = noisy(2 * i, of_reference), b = noisy(2 * i + 1, of_reference);
    const Image x = noisy(1000 + i, sigma);
    crossed += picture_error(x, reference_of(a, b)).relmse / 20;
    plain += picture_error(x, reference_of(a, a)).relmse / 20;
  }
  CHECK(relative_error(crossed, sigma * sigma) < 0.01);
  CHECK(plain > 1.2 * sigma * sigma);  // 25 % more: the reference's variance is a quarter
}

TEST_CASE("picture error: known values") {
  const Image one = noisy(0, 0, 1), half = noisy(0, 0, 0.5);
  const PictureError same = picture_error(one, reference_of(one, one));
  CHECK(same.relmse == 0);
  CHECK(same.smape == 0);
  const PictureError error = picture_error(half, reference_of(one, one));
  CHECK(relative_error(error.relmse, 0.25) < 1e-3);
  CHECK(relative_error(error.relmse_trimmed, 0.25) < 1e-3);
  Image black = noisy(0, 0, 0);
  CHECK(picture_error(black, reference_of(black, black)).relmse == 0);  // 0 / 0
}

TEST_CASE("bias: covers 0 for noise, is found where it is") {
  const ReferencePair reference = reference_of(noisy(1, 0.02), noisy(2, 0.02));
  BiasSums none, some;
  for (unsigned i = 0; i < 16; ++i) {
    none.add(noisy(100 + i, 0.2), reference);
    some.add(noisy(200 + i, 0.2, 1.03), reference);
  }
  const Interval95 no_bias = none.squared(reference), bias = some.squared(reference);
  CHECK(no_bias.lo < 0);
  CHECK(no_bias.hi > 0);
  CHECK(no_bias.hi < 2e-4);
  CHECK(bias.lo < 9e-4);
  CHECK(bias.hi > 9e-4);
  CHECK(bias.lo > 5e-4);
  const Interval95 mean = some.image_mean(reference, 100);
  CHECK(mean.lo < 0.03);
  CHECK(mean.hi > 0.03);
  CHECK(mean.lo > 0.025);
  CHECK(std::fabs(none.image_mean(reference, 100).value) < 0.004);
  CHECK(std::isnan(BiasSums().squared(reference).value));
}

TEST_CASE("curves: slope, seconds to an error, speed-up of exact power laws") {
  const Curve fast = power_law(1, -1.2, 1), slow = power_law(2, -1.2, 2);
  const CurveFigures figures = curve_figures(fast, {0.1 * std::pow(5.0, -1.2), 1e-9});
  REQUIRE(figures.points.size() == 6);
  CHECK(relative_error(figures.slope.value, -1.2) < 0.03);
  CHECK(figures.slope.lo < -1.2);
  CHECK(figures.slope.hi > -1.25);
  CHECK(relative_error(figures.seconds_to[0].value, 5) < 0.05);
  CHECK(figures.seconds_to[0].lo < 5);
  CHECK(figures.seconds_to[0].hi > 5);
  CHECK(std::isnan(figures.seconds_to[1].value));
  CHECK(figures.points[2].relmse.lo < figures.points[2].relmse.value);
  CHECK(relative_error(figures.points[2].efficiency, 1 / (figures.points[2].relmse.value * 4)) < 1e-9);
  const Versus v = versus(fast, slow);
  CHECK(relative_error(v.speed_up.value, 0.5) < 0.06);
  CHECK(v.speed_up.lo < 0.5);
  CHECK(v.speed_up.hi > 0.48);
  CHECK(relative_error(v.error_ratio.value, std::pow(2.0, 1.2)) < 0.06);
  CHECK(versus(fast, fast).speed_up.value == doctest::Approx(1));
  const std::vector<double> targets = default_targets({fast, slow});
  REQUIRE(!targets.empty());
  CHECK(targets.back() == doctest::Approx(0.01));
}

TEST_CASE("curves: coverage counts runs whose interval holds the mean error of all") {
  Curve curve = power_law(1, -1, 3);
  for (std::size_t r = 0; r < curve.runs.size(); ++r)
    for (RunPoint &p : curve.runs[r]) {
      p.lo95 = 0;
      p.hi95 = r < 4 ? 1e-9 : 1;
    }
  CHECK(curve_figures(curve, {}).points[1].coverage == 0.75);
}

TEST_CASE("curves: JSON, CSV and text hold every contestant") {
  SceneConvergence scene;
  scene.scene = "a \"b\".json";
  scene.curves = {power_law(1, -1.2, 1), power_law(2, -1.2, 2)};
  scene.curves[1].mode = Mode::kRecursive;
  scene.targets = {0.01};
  const Json json = Json::parse(convergence_json({scene}));
  CHECK(json["scenes"][0]["curves"][1]["mode"] == "recursive");
  CHECK(json["scenes"][0]["curves"][1]["versus_first"]["speed_up"]["value"].is_number());
  CHECK(json["scenes"][0]["curves"][0]["runs"].size() == 16);
  CHECK(json["scenes"][0]["curves"][0]["points"][0]["flip"].is_null());
  const std::string csv = convergence_csv({scene});
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 13);
  CHECK(csv.find("\"a \"\"b\"\".json\",recursive,sobol,16,2,") != std::string::npos);
  const std::string text = convergence_text(scene);
  CHECK(text.find("recursive, sobol") != std::string::npos);
  CHECK(text.find("seconds to relMSE 0.01") != std::string::npos);
  CHECK(convergence_summary_text({scene}) == "");
  CHECK(convergence_summary_text({scene, scene}).find("geometric means over 2 scenes") == 0);
}

TEST_CASE("error map: black where there is no error, bright where there is much") {
  ErrorMap map;
  const Image one = noisy(0, 0, 1);
  Image other = one;
  for (Channel &c : other.channels) c.values[5] *= 3;
  map.add(other, one);
  const Image image = map.image();
  CHECK(image.channels[0].values[0] == 0);
  CHECK(image.channels[0].values[5] > 0.9f);
  CHECK(image.channels[1].values[5] > 0.9f);
}
