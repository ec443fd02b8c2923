// The judge judged: the chi-square helper finds wrong densities and passes right ones.
#include "statistics.h"

#include <doctest/doctest.h>

#include "random.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double tilted(double tilt, double phi) {
  return (1 + tilt * (std::sin(10 * phi) < 0 ? -1 : 1)) / (2 * kPi);
}

/// Samples of a density over [0,1] x [0, 2 pi] that is off by +-tilt in every other of 20 columns.
Histogram tilted_samples(Grid grid, double tilt, std::uint64_t seed, int n) {
  Random random(seed);
  Histogram histogram(grid);
  while (histogram.total() < n) {
    const double x = random.fine(), phi = 2 * kPi * random.fine();
    if (random.fine() * tilted(tilt, 0.1) < tilted(tilt, phi)) histogram.add(x, phi);
  }
  return histogram;
}

double flat(double, double) { return 1 / (2 * kPi); }

}  // namespace

TEST_CASE("statistics: Sidak and the normal distribution") {
  CHECK(sidak(0.01, 1) == doctest::Approx(0.01).epsilon(1e-12));
  CHECK(1 - std::pow(1 - sidak(0.01, 1000), 1000) == doctest::Approx(0.01).epsilon(1e-9));
  CHECK(normal_two_sided(1.959963984540054) == doctest::Approx(0.05).epsilon(1e-10));
  CHECK(normal_two_sided(-10) == doctest::Approx(1.523970604832105e-23).epsilon(1e-10));
}

TEST_CASE("statistics: Simpson integrates polynomials, peaks and edges") {
  CHECK(integrate([](double x) { return x * x * x; }, 0, 2, 1e-9, 6) == doctest::Approx(4));
  const auto bump = [](double x, double y) { return std::exp(-40 * (x * x + y * y)); };
  CHECK(integrate(bump, -1, 1, -1, 1, 1e-9, 12) == doctest::Approx(kPi / 40).epsilon(1e-6));
  const auto edge = [](double x, double y) { return x + y < 0.7 ? 1.0 : 0.0; };
  CHECK(integrate(edge, 0, 1, 0, 1, 1e-6, 8) == doctest::Approx(0.245).epsilon(1e-3));
}

TEST_CASE("statistics: chi-square accepts the right density") {
  int rejected = 0;
  double mean_p = 0;
  for (int seed = 1; seed <= 100; ++seed) {
    const Histogram samples = tilted_samples(hemisphere_grid(10, 20), 0, seed, 20000);
    const Fit fit = chi_square_fit(samples, cell_masses(samples.grid(), flat));
    CHECK(fit.dof == 199);
    rejected += fit.p < 0.1;
    mean_p += fit.p / 100;
  }
  CHECK(std::abs(rejected - 10) <= 9);  // 3 sigma
  CHECK(mean_p == doctest::Approx(0.5).epsilon(0.2));
}

TEST_CASE("statistics: chi-square finds a density that is wrong by 2 %") {
  const Histogram right = tilted_samples(hemisphere_grid(10, 20), 0, 1, 1000000);
  CHECK(chi_square_fit(right, cell_masses(right.grid(), flat)).accepted());
  const Histogram wrong = tilted_samples(hemisphere_grid(10, 20), 0.02, 1, 1000000);
  CHECK_FALSE(chi_square_fit(wrong, cell_masses(wrong.grid(), flat)).accepted());
  const auto honest = [](double, double phi) { return tilted(0.02, phi); };
  CHECK(chi_square_fit(wrong, cell_masses(wrong.grid(), honest)).accepted());
}

TEST_CASE("statistics: chi-square counts invalid samples and stray ones") {
  const auto with_lost = [](double share, int stray) {
    Random random(7);
    Histogram histogram(hemisphere_grid(10, 20));
    for (int i = 0; i < 100000; ++i) {
      const double x = 0.5 * random.fine();
      if (random.fine() < share)
        histogram.add_invalid();
      else
        histogram.add(i < stray ? 0.9 : x, 2 * kPi * random.fine());
    }
    // Density 2 * 0.9 on the lower half of the grid, 0 on the upper.
    const auto density = [](double x, double) { return x < 0.5 ? 0.9 / kPi : 0.0; };
    std::vector<double> masses = cell_masses({5, 20, 0, 0.4999999999, 0, 2 * kPi}, density);
    masses.resize(200, 0.0);
    return chi_square_fit(histogram, masses);
  };
  CHECK(with_lost(0.10, 0).accepted());
  CHECK(with_lost(0.10, 0).lost == doctest::Approx(0.1).epsilon(0.05));
  CHECK_FALSE(with_lost(0.115, 0).accepted());
  CHECK_FALSE(with_lost(0.085, 0).accepted());
  CHECK_FALSE(with_lost(0.10, 100).accepted());
}
