// Statistics of paired runs on numbers small enough to check by hand.
#include "report/compare.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

using namespace phalanx;

namespace {

/// One pixel at (0, 0) with the given samples of red; green and blue are 1.
Film film_of(std::vector<float> reds) {
  Film film({0, 0, 2, 1}, false);
  InvalidSamples invalid;
  std::vector<float> samples;
  for (const float red : reds) samples.insert(samples.end(), {red, 1, 1});
  film.add_samples(0, 0, samples.data(), static_cast<int>(reds.size()), 0, invalid);
  return film;
}

ScheduleRuns runs_of(Mode mode, const std::vector<double> &seconds) {
  ScheduleRuns schedule{mode, 1, {}, {}};
  for (const double s : seconds) {
    RunStats run;
    run.wall_s = run.cpu_s = s;
    run.rays.camera = 1'000'000;
    run.stages = {{"shade", s / 2, 90, 90, 100}, {"film", s / 2, 90, 90, 900}};
    schedule.runs.push_back(run);
  }
  return schedule;
}

SceneComparison comparison_of(const std::string &scene, double speed_up) {
  SceneComparison c;
  c.scene = scene;
  c.schedules = {runs_of(Mode::kWavefront, {1, 2, 3}),
                 runs_of(Mode::kRecursive, {speed_up, 2 * speed_up, 3 * speed_up})};
  return c;
}

}  // namespace

TEST_CASE("compare: median and spread") {
  CHECK(spread_of({3}).median == 3);
  CHECK(spread_of({5, 1, 3}).median == 3);
  const Spread s = spread_of({4, 1, 2, 9});
  CHECK(s.median == 3);
  CHECK(s.min == 1);
  CHECK(s.max == 9);
}

TEST_CASE("compare: the interval of a median has the coverage of the sign test") {
  struct Case {
    int n;
    double lo, hi, coverage;  // of the values 1, 2, ..., n
  };
  // 1 - 2 P(Binomial(n, 1/2) < lo): tables of order statistics, and SciPy's binom.cdf.
  for (const Case &c : {Case{1, 1, 1, 0},
                        {2, 1, 2, 0.5},
                        {5, 1, 5, 0.9375},
                        {6, 1, 6, 0.96875},
                        {8, 1, 8, 0.9921875},
                        {9, 2, 8, 0.9609375},
                        {10, 2, 9, 0.978515625},
                        {20, 6, 15, 0.9586105346679688},
                        {25, 8, 18, 0.9567147493362427}}) {
    CAPTURE(c.n);
    std::vector<double> values;
    for (int i = c.n; i >= 1; i--) values.push_back(i);
    const MedianInterval interval = median_interval(values);
    CHECK(interval.lo == c.lo);
    CHECK(interval.hi == c.hi);
    CHECK(interval.coverage == doctest::Approx(c.coverage).epsilon(1e-12));
    CHECK(interval.median == (c.n + 1) / 2.0);
  }
}

TEST_CASE("compare: a slow spell that hits both runs of a pair does not show in the speed-up") {
  const MedianInterval r = paired_speed_up({2, 2, 20, 2, 2, 2}, {1, 1, 10, 1, 1, 1});
  CHECK(r.median == 2);
  CHECK(r.lo == 2);
  CHECK(r.hi == 2);
}

TEST_CASE("compare: geometric mean") {
  CHECK(geometric_mean({2, 8}) == doctest::Approx(4));
  CHECK(geometric_mean({3}) == doctest::Approx(3));
}

TEST_CASE("compare: films differ where a mean, a variance or a count does") {
  const Film reference = film_of({1, 3});
  CHECK(film_differences(film_of({1, 3}), reference).num_different == 0);
  CHECK(film_differences(film_of({1, 3}), reference).num_pixels == 2);
  CHECK(film_differences(film_of({0, 4}), reference).num_different == 1);        // same mean
  CHECK(film_differences(film_of({2, 2, 1, 3}), reference).num_different == 1);  // same mean
  const FilmDifferences d = film_differences(film_of({4, 4}), reference);
  CHECK(d.num_different == 1);
  CHECK(d.largest_relative == 0.5);
}

TEST_CASE("compare: lanes are weighed by time, without the film") {
  CHECK(lane_utilisation(runs_of(Mode::kWavefront, {1})) == doctest::Approx(0.9));
  CHECK(std::isnan(lane_utilisation(runs_of(Mode::kRecursive, {1}))));
  ScheduleRuns two = runs_of(Mode::kWavefront, {1});
  two.runs[0].stages = {{"a", 3, 10, 10, 10}, {"b", 1, 5, 5, 10}};
  CHECK(lane_utilisation(two) == doctest::Approx(0.875));
}

TEST_CASE("compare: only recursive may differ from depth-first") {
  SceneComparison c = comparison_of("a", 2);
  c.schedules[1].differences.num_different = 7;
  CHECK(has_equal_bits(c));
  c.scaling = {runs_of(Mode::kWavefront, {1, 1, 1})};
  c.scaling[0].differences.num_different = 1;
  CHECK_FALSE(has_equal_bits(c));
  CHECK(compare_text(c).find("NOT EQUAL") != std::string::npos);
}

TEST_CASE("compare: several scenes are summed up by the geometric mean of their speed-ups") {
  const std::vector<SceneComparison> both = {comparison_of("slow", 2), comparison_of("fast", 8)};
  CHECK(compare_summary_text({both[0]}) == "");
  const std::string text = compare_summary_text(both);
  CHECK(text.find("4.000   lowest 2.000: slow") != std::string::npos);
  const auto json = nlohmann::json::parse(compare_json(both));
  CHECK(json["geometric_mean_speed_up"]["wavefront"].get<double>() == doctest::Approx(4));
  CHECK(json["geometric_mean_speed_up"]["recursive"].get<double>() == doctest::Approx(1));
  const auto &wavefront = json["scenes"][0]["schedules"][0];
  CHECK(wavefront["seconds"]["median"] == 2);
  CHECK(wavefront["seconds"]["runs"] == nlohmann::json({1, 2, 3}));
  CHECK(wavefront["mrays_per_s"].get<double>() == doctest::Approx(0.5));
  CHECK(json["scenes"][0]["schedules"][1]["utilisation"].is_null());
}
