#include "albedo_tables.h"

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/albedo_table.h"
#include "../../kernels/physics/bsdf_glossy_conductor.h"
#include "../../kernels/physics/bsdf_principled.h"

namespace phalanx {
namespace {

constexpr int kRows = PHALANX_ALBEDO_ROWS, kColumns = PHALANX_ALBEDO_COLUMNS;
constexpr int kSlopes = 32;            // microfacet normals per entry: slopes ...
constexpr int kTurns = 32;             // ... times azimuths of a whole turn
constexpr int kAzimuths = 64;          // of a quarter turn, for averages of anisotropic tables
constexpr double kLeastCosine = 1e-4;  // stands for 0, where the albedo has a limit but no formula
constexpr double kQuarterTurn = 1.57079632679489662;

using Row = std::array<double, kColumns>;
using Table = std::array<Row, kRows>;
using Averages = std::array<double, kRows>;

double column_cosine(double column) {
  const double root = column / (kColumns - 1);
  return std::max(root * root, kLeastCosine);
}
double row_coordinate(double row) { return row / (kRows - 1); }
double row_alpha(double row) { return row_coordinate(row) * row_coordinate(row); }

Vec3 direction(double cosine, double azimuth) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return vec3(static_cast<float>(sine * std::cos(azimuth)),
              static_cast<float>(sine * std::sin(azimuth)), static_cast<float>(cosine));
}

float white(float) { return 1.0f; }

/// Share of light from wo that GGX microfacets reflect once; `fresnel(cosine)` is their reflectance.
/// Steps of slope are finer where it is steep (u.x near 1): those normals lose light. An isotropic
/// surface is symmetric about the plane of wo, which is y = 0 then: half a turn will do.
template <typename Fresnel>
double single_scattering(Vec3 wo, Vec2 alpha, const Fresnel &fresnel) {
  const int turns = alpha.x == alpha.y ? kTurns / 2 : kTurns;
  const float lambda_o = ggx_lambda(wo, alpha);
  double sum = 0;
  for (int i = 0; i < kSlopes; ++i)
    for (int j = 0; j < turns; ++j) {
      const float root = (static_cast<float>(i) + 0.5f) / kSlopes;
      const Vec2 u = vec2(1.0f - root * root, (static_cast<float>(j) + 0.5f) / kTurns);
      const Vec3 h = sample_ggx_visible(wo, alpha, u);
      const float wo_h = std::min(dot(wo, h), 1.0f);
      const Vec3 wi = h * (2.0f * wo_h) - wo;
      if (!(wi.z > 0.0f)) continue;
      const float shadowing = (1.0f + lambda_o) / (1.0f + lambda_o + ggx_lambda(wi, alpha));
      sum += static_cast<double>(2.0f * root * fresnel(wo_h) * shadowing);
    }
  return sum / (kSlopes * turns);
}

/// 2 int f mu dmu of f(column), columns being steps of sqrt(mu); exact for functions that are linear
/// between whole columns (Gauss: degree 5).
template <typename Function>
double hemisphere_average(const Function &f) {
  constexpr double kNodes[] = {0.112701665379258, 0.5, 0.887298334620742};
  constexpr double kWeights[] = {5.0 / 18, 4.0 / 9, 5.0 / 18};
  double sum = 0;
  for (int cell = 0; cell + 1 < kColumns; ++cell)
    for (int i = 0; i < 3; ++i) {
      const double column = cell + kNodes[i], root = column / (kColumns - 1);
      sum += kWeights[i] * 4 * root * root * root * f(column);
    }
  return sum / (kColumns - 1);
}

/// Average of a row, linear between its numbers.
double row_average(const Row &row) {
  return hemisphere_average([&](double column) {
    const auto cell = static_cast<std::size_t>(column);
    const double t = column - std::floor(column);
    return row[cell] * (1 - t) + row[cell + 1] * t;
  });
}

/// Average of a reflectance; `fresnel(cosine)`.
template <typename Fresnel>
double smooth_average(const Fresnel &fresnel) {
  return hemisphere_average([&](double column) {
    const double root = column / (kColumns - 1);
    return static_cast<double>(fresnel(static_cast<float>(root * root)));
  });
}

/// Rows sqrt(alpha) with their averages; row 0 is smooth.
template <typename Fresnel>
void fill_isotropic(Table &table, Averages &averages, const Fresnel &fresnel) {
  for (int r = 0; r < kRows; ++r) {
    const auto alpha = static_cast<float>(row_coordinate(r) * row_coordinate(r));
    Row &row = table[static_cast<std::size_t>(r)];
    for (int c = 0; c < kColumns; ++c) {
      const double mu = column_cosine(c);
      row[static_cast<std::size_t>(c)] =
          r == 0 ? static_cast<double>(fresnel(static_cast<float>(mu)))
                 : single_scattering(direction(mu, 0), vec2(alpha, alpha), fresnel);
    }
    averages[static_cast<std::size_t>(r)] = r == 0 ? smooth_average(fresnel) : row_average(row);
  }
}

/// Fills a table with albedo(row, column) from above. Where albedos change within a cell, in the first
/// rows, the table is raised until it is too low in the middle of no cell and of no step of columns.
/// `margin`: what is added besides, as a factor; `most`: what no number exceeds. Averages are those
/// of the table.
template <typename Albedo>
void fill_from_above(Table &table, Averages &averages, double margin, double most,
                     const Albedo &albedo) {
  constexpr int kSharpRows = kRows / 4;
  const auto entry = [](Table &t, int r, int c) -> double & {
    return t[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  };
  Table exact;
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c) entry(exact, r, c) = albedo(r, c);
  table = exact;
  const auto raise = [&](int r, int c, double lack) {
    entry(table, r, c) = std::max(entry(table, r, c), entry(exact, r, c) + lack);
  };
  for (int r = 0; r < kSharpRows; ++r)
    for (int c = 0; c + 1 < kColumns; ++c) {
      const double above = entry(exact, r, c) + entry(exact, r, c + 1);
      const double below = entry(exact, r + 1, c) + entry(exact, r + 1, c + 1);
      const double lack = albedo(r, c + 0.5) - 0.5 * above;
      const double lack_between = albedo(r + 0.5, c + 0.5) - 0.25 * (above + below);
      for (const int i : {c, c + 1}) {
        raise(r, i, std::max(lack, lack_between));
        raise(r + 1, i, lack_between);
      }
    }
  for (Row &row : table)
    for (double &value : row) value = std::min(value * margin, most);
  std::transform(table.begin(), table.end(), averages.begin(), row_average);
}

float schlick_weight(float cosine) {
  const float x = 1.0f - cosine;
  return x * x * x * x * x;
}

/// Albedo of white sheen, without the scale that keeps it below 1.
double sheen_albedo(float alpha, double mu) {
  constexpr int kSteps = 24;  // finer towards the horizon and the forward direction, where sheen is
  const Vec3 wo = direction(mu, kQuarterTurn * 2);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = (i + 0.5) / kSteps, y = (j + 0.5) / kSteps;
      const double cosine = x * x;
      const Vec3 wi = direction(cosine, 2 * kQuarterTurn * y * y);
      const Vec3 h = safe_normalize(wo + wi, vec3(0, 0, 1));
      sum += 16 * kQuarterTurn * x * y * cosine *
             static_cast<double>(sheen_value(alpha, wo.z, wi.z, h));
    }
  return sum / (kSteps * kSteps);
}

/// Azimuth of a row, the inverse of glossy_row().
double row_azimuth(int row, Vec2 alpha) {
  const double t = row_coordinate(row);
  return std::atan2(t * std::sqrt(static_cast<double>(alpha.x)),
                    (1 - t) * std::sqrt(static_cast<double>(alpha.y)));
}

/// Average over all azimuths, as lookups see the table.
double average_of_azimuths(const Table &table, Vec2 alpha) {
  double sum = 0;
  for (int i = 0; i < kAzimuths; ++i) {
    const Vec3 w = direction(0.5, (i + 0.5) / kAzimuths * kQuarterTurn);
    const TableCell cell = table_cell(glossy_row(alpha, w), kRows);
    const auto row = static_cast<std::size_t>(cell.index);
    const double t = static_cast<double>(cell.at);
    sum += row_average(table[row]) * (1 - t) + row_average(table[row + 1]) * t;
  }
  return sum / kAzimuths;
}

void fill_anisotropic(Table &table, Averages &averages, Vec2 alpha) {
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c)
      table[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
          single_scattering(direction(column_cosine(c), row_azimuth(r, alpha)), alpha, white);
  averages.fill(average_of_azimuths(table, alpha));
}

}  // namespace

template <typename Make>
std::int32_t AlbedoTables::find_or_make(const std::array<float, 3> &key, const Make &make) {
  const auto found = made_.find(key);
  if (found != made_.end()) return found->second;
  Table table;
  Averages averages;
  make(table, averages);
  const auto first = static_cast<std::int32_t>(tables_.size());
  for (const Row &row : table)
    for (const double value : row) tables_.push_back(static_cast<float>(value));
  for (const double value : averages) tables_.push_back(static_cast<float>(value));
  made_[key] = first;
  return first;
}

std::int32_t AlbedoTables::microfacets() {
  return find_or_make(
      {0, 0, 0}, [](Table &table, Averages &averages) { fill_isotropic(table, averages, white); });
}

std::int32_t AlbedoTables::microfacets(float alpha_x, float alpha_y) {
  return find_or_make({0, alpha_x, alpha_y}, [&](Table &table, Averages &averages) {
    fill_anisotropic(table, averages, vec2(alpha_x, alpha_y));
  });
}

std::int32_t AlbedoTables::dielectric(float ior) {
  return find_or_make({ior, 0, 0}, [&](Table &table, Averages &averages) {
    fill_isotropic(table, averages, [ior](float cosine) {
      const Refraction r = fresnel_dielectric(cosine, ior);
      return r.reflectance;
    });
  });
}

std::int32_t AlbedoTables::principled() {
  const auto microfacets = [](const auto &fresnel) {
    return [fresnel](double row, double column) {
      const double mu = column_cosine(column), alpha = row_alpha(row);
      if (row == 0) return static_cast<double>(fresnel(static_cast<float>(mu)));
      const float a = static_cast<float>(alpha);
      return single_scattering(direction(mu, 0), vec2(a, a), fresnel);
    };
  };
  const auto sheen = [](double row, double column) {
    const float alpha = max_of(static_cast<float>(row_alpha(row)), PHALANX_LEAST_SHEEN_ALPHA);
    return sheen_albedo(alpha, column_cosine(column));
  };
  // Made at once, so that they follow one another.
  const std::int32_t first = find_or_make({-1, 0, 0}, [&](Table &table, Averages &averages) {
    fill_from_above(table, averages, 1.002, 1, microfacets(white));
  });
  find_or_make({-2, 0, 0}, [&](Table &table, Averages &averages) {
    fill_from_above(table, averages, 1.006, 1, microfacets(schlick_weight));
  });
  find_or_make({-3, 0, 0}, [&](Table &table, Averages &averages) {
    fill_from_above(table, averages, 1.01, HUGE_VAL, sheen);
  });
  return first;
}

double average_fresnel(double eta, double k) {
  return smooth_average([&](float cosine) {
    return fresnel_conductor(cosine, static_cast<float>(eta), static_cast<float>(k));
  });
}

}  // namespace phalanx
