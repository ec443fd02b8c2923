// The sky: finite and of the right brightness at every hour, with the sun where it is said to be.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../src/scene/sky.h"

using namespace phalanx;

namespace {

constexpr double kPi = 3.14159265358979323846;

SkyDescription at_elevation(double degrees, double turbidity = 3) {
  SkyDescription sky;
  const double angle = degrees * kPi / 180;
  sky.sun_direction = {0, std::sin(angle), -std::cos(angle)};
  sky.turbidity = turbidity;
  return sky;
}

Double3 texel(const EnvironmentMap &map, int column, int row) {
  const float *const t = &map.texels[static_cast<std::size_t>(row * map.width + column) * 3];
  return {static_cast<double>(t[0]), static_cast<double>(t[1]), static_cast<double>(t[2])};
}

/// cd m^-2.
double photometric(const Double3 &c) {
  return 683 * (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
}

/// Of the upper half, lx on level ground.
double illuminance(const EnvironmentMap &map) {
  double sum = 0;
  for (int row = 0; row < map.height / 2; ++row)
    for (int column = 0; column < map.width; ++column) {
      const double theta = kPi * (row + 0.5) / map.height;
      sum += photometric(texel(map, column, row)) * std::cos(theta) * std::sin(theta) * kPi /
             map.height * 2 * kPi / map.width;
    }
  return sum;
}

}  // namespace

TEST_CASE("sky: every texel is finite and not negative, by day, at dusk and at night") {
  for (const double elevation : {90.0, 30.0, 0.5, 0.0, -0.5, -8.0, -90.0})
    for (const double turbidity : {1.0, 10.0}) {
      const Sky sky = make_sky(at_elevation(elevation, turbidity));
      CAPTURE(elevation);
      CAPTURE(turbidity);
      REQUIRE(sky.map.texels.size() ==
              static_cast<std::size_t>(sky.map.width * sky.map.height * 3));
      CHECK(std::all_of(sky.map.texels.begin(), sky.map.texels.end(),
                        [](float x) { return x >= 0 && std::isfinite(x); }));
      for (const double c : sky.sun) CHECK((c >= 0 && std::isfinite(c)));
      if (elevation != 0) CHECK((sky.sun[1] > 0) == (elevation > 0));
      CHECK((illuminance(sky.map) > 0) == (elevation > -20));
    }
}

TEST_CASE("sky: brightness is that of clear skies") {
  // Sun at 45 degrees, clear air. Measured skies: 2 to 6 kcd m^-2 at the zenith, 10 to 30 klx from the sky,
  // 70 to 95 klx from the sun across its rays, 1.6e9 cd m^-2 on its disc outside the air.
  const Sky sky = make_sky(at_elevation(45));
  const double zenith = photometric(texel(sky.map, 0, 0)), diffuse = illuminance(sky.map);
  CHECK((zenith > 2000 && zenith < 6000));
  CHECK((diffuse > 10000 && diffuse < 30000));
  const double half = 0.533 / 2 * kPi / 180, disc = photometric(sky.sun);
  const double direct = disc * kPi * std::sin(half) * std::sin(half);
  CHECK((direct > 70000 && direct < 95000));
  CHECK(disc < 2e9);
  // The ground is its albedo of what falls on it.
  const double ground = photometric(texel(sky.map, 0, sky.map.height - 1));
  CHECK(ground ==
        doctest::Approx(0.3 / kPi * (direct * std::sin(kPi / 4) + diffuse)).epsilon(0.01));
  // Civil twilight ends at some 3 to 7 lx.
  const double dusk = illuminance(make_sky(at_elevation(-6)).map);
  CHECK((dusk > 1 && dusk < 15));
}

TEST_CASE("sky: blue overhead, red at sunset, white in haze, brightest around the sun") {
  const Sky noon = make_sky(at_elevation(60, 2)), evening = make_sky(at_elevation(2, 2)),
            haze = make_sky(at_elevation(60, 8));
  const auto blueness = [](const Double3 &c) { return c[2] / c[0]; };
  CHECK(blueness(texel(noon.map, 0, 100)) > 1.8);
  CHECK(blueness(texel(haze.map, 0, 100)) < blueness(texel(noon.map, 0, 100)));
  CHECK(blueness(evening.sun) < 0.2);
  CHECK(blueness(noon.sun) > 0.5);
  // The middle column is towards the sun, 30 degrees from the zenith.
  const int width = noon.map.width, row = noon.map.height / 6;
  CHECK(photometric(texel(noon.map, width / 2, row)) > 5 * photometric(texel(noon.map, 0, row)));
  // Left and right of the sun are mirror images.
  for (int column = 0; column < width / 2; ++column)
    CHECK(texel(noon.map, column, 70) == texel(noon.map, width - 1 - column, 70));
}

TEST_CASE("sky: scale, albedo and the sun's size do what they say") {
  SkyDescription description = at_elevation(30);
  const Sky plain = make_sky(description);
  description.scale = 0.5;
  const Sky half = make_sky(description);
  CHECK(half.sun[1] == doctest::Approx(0.5 * plain.sun[1]));
  CHECK(texel(half.map, 3, 40)[1] == doctest::Approx(0.5 * texel(plain.map, 3, 40)[1]));
  description.scale = 1;
  description.angular_diameter = 5.33;
  CHECK(make_sky(description).sun[1] == doctest::Approx(plain.sun[1] / 100).epsilon(0.02));
  description.ground_albedo = {0, 0, 0};
  CHECK(texel(make_sky(description).map, 0, 200) == Double3{0, 0, 0});
}
