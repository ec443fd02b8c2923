#include "sky.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "../../kernels/physics/mathx.h"

namespace phalanx {
namespace {

using std::size_t;

// Lengths are kilometres, coefficients 1 / km.
constexpr double kPi = 3.14159265358979323846;
constexpr double kGround = 6360, kTop = 6460;  // radii
constexpr double kRayleighHeight = 8, kMieHeight = 1.2;
constexpr Double3 kRayleigh = {5.802e-3, 13.558e-3, 33.1e-3};  // scattering at sea level
constexpr Double3 kOzone = {0.650e-3, 1.881e-3, 0.085e-3};     // absorption at 25 km
// Haze: extinction over that at 550 nm, after Angstrom with exponent 1.3.
constexpr Double3 kMieSpectrum = {0.7590, 1, 1.3365};
constexpr double kMieAlbedo = 0.9, kMieForward = 0.8;
constexpr int kRows = 256;  // of the map: 0.7 degrees
// Outside the air: 133 100 lux in the colour of a black body of 5777 K.
constexpr Double3 kSun = {194.9 * 1.111, 194.9 * 0.976, 194.9 * 0.914};

/// e^x with the kernels' own polynomial: the same bits on every machine.
double exponential(double x) { return static_cast<double>(exp_of(static_cast<float>(x))); }

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Squared sine of half an angle.
double sin2_of_half(double degrees) {
  const double sine = static_cast<double>(sincos_turns(static_cast<float>(degrees / 720)).sine);
  return sine * sine;
}

double rayleigh_phase(double cosine) { return 3 / (16 * kPi) * (1 + cosine * cosine); }

/// Cornette and Shanks 1992.
double mie_phase(double cosine) {
  constexpr double g = kMieForward, g2 = g * g;
  const double x = 1 + g2 - 2 * g * cosine;
  return 3 / (8 * kPi) * (1 - g2) * (1 + cosine * cosine) / ((2 + g2) * x * std::sqrt(x));
}

/// Bilinear table over the unit square.
template <size_t Width, size_t Height>
struct Table {
  std::vector<Double3> values = std::vector<Double3>(Width * Height);

  Double3 &at(size_t x, size_t y) { return values[y * Width + x]; }
  Double3 operator()(double x, double y) const {
    const double px = std::clamp(x, 0.0, 1.0) * (Width - 1);
    const double py = std::clamp(y, 0.0, 1.0) * (Height - 1);
    const auto i = std::min(static_cast<size_t>(px), Width - 2);
    const auto j = std::min(static_cast<size_t>(py), Height - 2);
    const double fx = px - static_cast<double>(i), fy = py - static_cast<double>(j);
    const Double3 *const v = &values[j * Width + i];
    Double3 result;
    for (size_t c = 0; c < 3; ++c)
      result[c] = (v[0][c] * (1 - fx) + v[1][c] * fx) * (1 - fy) +
                  (v[Width][c] * (1 - fx) + v[Width + 1][c] * fx) * fy;
    return result;
  }
};

/// Distance to the top of the air from radius r in a direction of cosine mu to the zenith.
double distance_to_top(double r, double mu) {
  return -r * mu + std::sqrt(std::max(r * r * (mu * mu - 1) + kTop * kTop, 0.0));
}

/// Distance to the ground, or a negative number.
double distance_to_ground(double r, double mu) {
  const double discriminant = r * r * (mu * mu - 1) + kGround * kGround;
  return mu < 0 && discriminant >= 0 ? -r * mu - std::sqrt(discriminant) : -1;
}

/// Calls visit(distance of the middle, length) for `steps` pieces of a ray, shorter ones first.
template <typename Visit>
void march(double distance, int steps, const Visit &visit) {
  double from = 0;
  for (int i = 1; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps, to = distance * s * s;
    visit(0.5 * (from + to), to - from);
    from = to;
  }
}

struct Medium {
  Double3 rayleigh, mie, extinction;  // scattering by each; by all, with absorption
};

class Atmosphere {
 public:
  explicit Atmosphere(const SkyDescription &sky);

  /// From radius r to outside the air; 0 where the earth is in the way of most of the sun.
  Double3 sun_transmittance(double r, double mu) const;
  /// What an observer on the ground sees in unit direction `view` (y up) with the sun at `sun`.
  Double3 radiance(const Double3 &view, const Double3 &sun) const;

 private:
  Medium medium(double r) const;
  void fill_transmittance();
  void fill_multiple();
  Double3 multiple(double r, double mu_sun) const {
    return multiple_(0.5 + 0.5 * mu_sun, (r - kGround) / (kTop - kGround));
  }

  double mie_extinction_;  // at sea level, 550 nm
  double sun_radius_;      // sine of the angle
  Double3 albedo_;
  Table<256, 64> transmittance_;
  Table<32, 32> multiple_;
};

Atmosphere::Atmosphere(const SkyDescription &sky)
    : mie_extinction_((sky.turbidity - 1) * kRayleigh[1] * kRayleighHeight / kMieHeight),
      sun_radius_(std::sqrt(sin2_of_half(sky.angular_diameter))),
      albedo_(sky.ground_albedo) {
  fill_transmittance();
  fill_multiple();
}

Medium Atmosphere::medium(double r) const {
  const double h = std::max(r - kGround, 0.0);
  const double rayleigh = exponential(-h / kRayleighHeight), mie = exponential(-h / kMieHeight);
  const double ozone = std::max(0.0, 1 - std::fabs(h - 25) / 15);
  Medium m;
  for (size_t c = 0; c < 3; ++c) {
    const double haze = mie_extinction_ * kMieSpectrum[c] * mie;
    m.rayleigh[c] = kRayleigh[c] * rayleigh;
    m.mie[c] = kMieAlbedo * haze;
    m.extinction[c] = m.rayleigh[c] + haze + kOzone[c] * ozone;
  }
  return m;
}

// Over radius and distance to the top, as in Bruneton and Neyret, "Precomputed Atmospheric Scattering"
// (EGSR 2008): resolves the horizon.
constexpr double kHorizon2 = kTop * kTop - kGround * kGround;

void Atmosphere::fill_transmittance() {
  for (size_t j = 0; j < 64; ++j) {
    const double to_horizon2 = kHorizon2 * static_cast<double>(j * j) / (63.0 * 63.0);
    const double r = std::sqrt(to_horizon2 + kGround * kGround);
    for (size_t i = 0; i < 256; ++i) {
      const double least = kTop - r, most = std::sqrt(to_horizon2) + std::sqrt(kHorizon2);
      const double d = least + (most - least) * static_cast<double>(i) / 255;
      const double mu =
          d > 0 ? std::clamp((kHorizon2 - to_horizon2 - d * d) / (2 * r * d), -1.0, 1.0) : 1.0;
      Double3 depth = {0, 0, 0};
      march(d, 64, [&](double s, double ds) {
        const Medium m = medium(std::sqrt(r * r + s * s + 2 * r * s * mu));
        for (size_t c = 0; c < 3; ++c) depth[c] += m.extinction[c] * ds;
      });
      for (size_t c = 0; c < 3; ++c) transmittance_.at(i, j)[c] = exponential(-depth[c]);
    }
  }
}

Double3 Atmosphere::sun_transmittance(double r, double mu) const {
  const double horizon = -std::sqrt(std::max(1 - (kGround / r) * (kGround / r), 0.0));
  const double seen = smooth_step(horizon - sun_radius_, horizon + sun_radius_, mu);
  if (!(seen > 0)) return {0, 0, 0};
  const double to_horizon = std::sqrt(std::max(r * r - kGround * kGround, 0.0));
  const double least = kTop - r, most = to_horizon + std::sqrt(kHorizon2);
  const double d = distance_to_top(r, std::max(mu, horizon));
  Double3 t = transmittance_((d - least) / (most - least), to_horizon / std::sqrt(kHorizon2));
  for (double &value : t) value *= seen;
  return t;
}

/// Hillaire's equations 5 to 10: light of second order from all sides, for a sun of irradiance 1, times the
/// geometric series of the orders after it. The phase function is taken as constant.
void Atmosphere::fill_multiple() {
  for (size_t j = 0; j < 32; ++j)
    for (size_t i = 0; i < 32; ++i) {
      const double r = kGround + (kTop - kGround) * (static_cast<double>(j) + 1e-3) / 31.002;
      const double mu_sun = 2 * static_cast<double>(i) / 31 - 1;
      const Double3 sun = {std::sqrt(1 - mu_sun * mu_sun), mu_sun, 0};
      Double3 second = {0, 0, 0}, more = {0, 0, 0};
      constexpr int kSide = 8;
      for (int k = 0; k < kSide * kSide; ++k) {
        const double mu = (k / kSide + 0.5) * 2 / kSide - 1;
        const float turns = (static_cast<float>(k % kSide) + 0.5f) / (2 * kSide);  // mirrored half
        const Double3 w = {std::sqrt(1 - mu * mu) * static_cast<double>(sincos_turns(turns).cosine),
                           mu, 0};
        const double ground = distance_to_ground(r, mu);
        const double distance = ground > 0 ? ground : distance_to_top(r, mu);
        const double cos_sun = w[0] * sun[0] + w[1] * sun[1];
        const auto cosine_at = [&](double s, double at) { return (r * mu_sun + s * cos_sun) / at; };
        Double3 through = {1, 1, 1};
        march(distance, 20, [&](double s, double ds) {
          const double at = std::sqrt(r * r + s * s + 2 * r * s * mu);
          const Medium m = medium(at);
          const Double3 t = sun_transmittance(at, cosine_at(s, at));
          for (size_t c = 0; c < 3; ++c) {
            const double rest = exponential(-m.extinction[c] * ds);
            const double scattered =
                through[c] * (1 - rest) / m.extinction[c] * (m.rayleigh[c] + m.mie[c]);
            second[c] += scattered * t[c] / (4 * kPi);
            more[c] += scattered;
            through[c] *= rest;
          }
        });
        if (ground > 0) {
          const double mu_ground = cosine_at(ground, kGround);
          const Double3 t = sun_transmittance(kGround, mu_ground);
          for (size_t c = 0; c < 3; ++c)
            second[c] += through[c] * t[c] * std::max(mu_ground, 0.0) * albedo_[c] / kPi;
        }
      }
      for (size_t c = 0; c < 3; ++c) {
        const double part = 1.0 / (kSide * kSide);
        multiple_.at(i, j)[c] = second[c] * part / (1 - std::min(more[c] * part, 0.99));
      }
    }
}

Double3 Atmosphere::radiance(const Double3 &view, const Double3 &sun) const {
  constexpr double r = kGround + 0.001;
  const double cos_sun = view[0] * sun[0] + view[1] * sun[1] + view[2] * sun[2];
  const double rayleigh = rayleigh_phase(cos_sun), mie = mie_phase(cos_sun);
  Double3 sum = {0, 0, 0}, through = {1, 1, 1};
  march(distance_to_top(r, view[1]), 64, [&](double s, double ds) {
    const double at = std::sqrt(r * r + s * s + 2 * r * s * view[1]);
    const double mu_sun = (r * sun[1] + s * cos_sun) / at;
    const Medium m = medium(at);
    const Double3 direct = sun_transmittance(at, mu_sun), indirect = multiple(at, mu_sun);
    for (size_t c = 0; c < 3; ++c) {
      const double rest = exponential(-m.extinction[c] * ds);
      const double source = (m.rayleigh[c] * rayleigh + m.mie[c] * mie) * direct[c] +
                            (m.rayleigh[c] + m.mie[c]) * indirect[c];
      sum[c] += through[c] * source * (1 - rest) / m.extinction[c];
      through[c] *= rest;
    }
  });
  for (size_t c = 0; c < 3; ++c) sum[c] *= kSun[c];
  return sum;
}

void put(EnvironmentMap &map, int column, int row, const Double3 &radiance) {
  float *const texel = &map.texels[(static_cast<size_t>(row) * static_cast<size_t>(map.width) +
                                    static_cast<size_t>(column)) *
                                   3];
  for (size_t c = 0; c < 3; ++c) texel[c] = static_cast<float>(radiance[c]);
}

/// Fills the map above the horizon; returns the irradiance that it gives to level ground.
Double3 put_air(const SkyDescription &sky, const Atmosphere &air, EnvironmentMap &map) {
  const double up = sky.sun_direction[1];
  const Double3 sun = {0, up, -std::sqrt(std::max(1 - up * up, 0.0))};
  Double3 irradiance = {0, 0, 0};
  for (int row = 0; row < map.height / 2; ++row) {
    const SinCos polar =
        sincos_turns((static_cast<float>(row) + 0.5f) / static_cast<float>(2 * map.height));
    const double height = static_cast<double>(polar.cosine), ring = static_cast<double>(polar.sine);
    const double weight = height * ring * (kPi / map.height) * (2 * kPi / map.width);  // cos dw
    for (int column = 0; column < map.width / 2; ++column) {
      const SinCos around =
          sincos_turns((static_cast<float>(column) + 0.5f) / static_cast<float>(map.width) - 0.5f);
      const Double3 view = {ring * static_cast<double>(around.sine), height,
                            -ring * static_cast<double>(around.cosine)};
      const Double3 radiance = air.radiance(view, sun);
      for (size_t c = 0; c < 3; ++c) irradiance[c] += 2 * radiance[c] * weight;
      put(map, column, row, radiance);
      put(map, map.width - 1 - column, row, radiance);
    }
  }
  return irradiance;
}

}  // namespace

Sky make_sky(const SkyDescription &description) {
  const Atmosphere air(description);
  const double up = description.sun_direction[1];
  Sky sky;
  sky.map.width = 2 * kRows;
  sky.map.height = kRows;
  sky.map.texels.resize(static_cast<size_t>(sky.map.width) * kRows * 3);
  const Double3 diffuse = put_air(description, air, sky.map);
  const Double3 sun = air.sun_transmittance(kGround, up);
  Double3 ground;
  for (size_t c = 0; c < 3; ++c) {
    const double direct = kSun[c] * sun[c];
    ground[c] = description.ground_albedo[c] / kPi * (direct * std::max(up, 0.0) + diffuse[c]);
    sky.sun[c] = description.scale * direct / (kPi * sin2_of_half(description.angular_diameter));
  }
  for (int row = kRows / 2; row < kRows; ++row)
    for (int column = 0; column < sky.map.width; ++column) put(sky.map, column, row, ground);
  for (float &texel : sky.map.texels) texel *= static_cast<float>(description.scale);
  return sky;
}

}  // namespace phalanx
