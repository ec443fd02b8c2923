#include "build_environment.h"

#include <algorithm>

#include "../output/image_file.h"
#include "build_report.h"
#include "turn.h"
#include "value_checks.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr double kPi = 3.14159265358979323846;
/// Kernels address arrays with 32-bit byte offsets; 16384 x 8192.
constexpr std::int64_t kMaxTexels = std::int64_t{1} << 27;

double luminance_of(const float *texel) {
  return 0.2126 * static_cast<double>(texel[0]) + 0.7152 * static_cast<double>(texel[1]) +
         0.0722 * static_cast<double>(texel[2]);
}

/// Fills cdf[0..weights.size()] from 0 to 1 in proportion to the weights; evenly if all are 0. Returns their
/// sum.
double make_distribution(const std::vector<double> &weights, double *cdf) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  double below = 0;
  cdf[0] = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    below += weights[i];
    cdf[i + 1] =
        sum > 0 ? below / sum : static_cast<double>(i + 1) / static_cast<double>(weights.size());
  }
  return sum;
}

/// The mean of what bilinear interpolation makes of a row over each of its texels: of its own value 6/8, of
/// each neighbour's 1/8. Above 0 wherever the texel shows any light.
void blur_row(std::vector<double> &row) {
  const std::vector<double> from = row;
  const size_t n = from.size();
  for (size_t i = 0; i < n; ++i)
    row[i] = (from[(i + n - 1) % n] + 6 * from[i] + from[(i + 1) % n]) / 8;
}

/// The same down the columns; beyond a pole there is the last row again.
std::vector<double> blur_rows(const std::vector<double> &above, const std::vector<double> &row,
                              const std::vector<double> &below) {
  std::vector<double> result(row.size());
  for (size_t i = 0; i < row.size(); ++i) result[i] = (above[i] + 6 * row[i] + below[i]) / 8;
  return result;
}

std::vector<double> luminance_row(const EnvironmentMap &map, int row) {
  const int inside = std::clamp(row, 0, map.height - 1);
  const auto width = static_cast<size_t>(map.width);
  std::vector<double> result(width);
  for (size_t i = 0; i < width; ++i)
    result[i] = luminance_of(&map.texels[(static_cast<size_t>(inside) * width + i) * 3]);
  blur_row(result);
  return result;
}

/// Copies the planes of an image; returns how many values were not usable.
std::int64_t copy_texels(const std::array<const float *, 3> &planes, const Double3 &scale,
                         EnvironmentMap &map) {
  std::int64_t num_bad = 0;
  const size_t count = static_cast<size_t>(map.width) * static_cast<size_t>(map.height);
  map.texels.resize(3 * count);
  for (size_t i = 0; i < count; ++i)
    for (size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>(planes[c][i]) * scale[c];
      const bool good = value >= 0 && value <= kMaxRadiance;
      map.texels[3 * i + c] = good ? static_cast<float>(value) : 0.0f;
      num_bad += good ? 0 : 1;
    }
  return num_bad;
}

}  // namespace

EnvironmentMap read_environment_map(const EnvironmentMapDescription &description,
                                    Diagnostics &diagnostics) {
  EnvironmentMap map;
  try {
    const Image image = read_image(description.file);
    const std::array<const float *, 3> planes = rgb_planes(image);
    if (planes[0] == nullptr || planes[1] == nullptr || planes[2] == nullptr)
      throw InputError("'" + description.file + "' has no channels R, G and B");
    if (image.num_pixels() > kMaxTexels)
      throw InputError("'" + description.file + "' is larger than 2^27 pixels");
    map.width = image.width;
    map.height = image.height;
    map.turns = description.rotation / 360;
    const std::int64_t num_bad = copy_texels(planes, description.scale, map);
    if (num_bad > 0)
      diagnostics.warn(problem_at(description.origin,
                                  std::to_string(num_bad) + " values of '" + description.file +
                                      "' are negative, not finite or above 1e36: they are black"));
  } catch (const InputError &error) {
    for (const Problem &problem : error.problems())
      diagnostics.error(problem_at(description.origin, problem.text()));
    return {};
  }
  return map;
}

double set_environment_map(EnvironmentMap map, Scene &scene) {
  const auto width = static_cast<size_t>(map.width), height = static_cast<size_t>(map.height);
  std::vector<double> rows(height), columns(height * (width + 1));
  std::vector<double> above = luminance_row(map, -1), row = luminance_row(map, 0);
  for (size_t j = 0; j < height; ++j) {
    std::vector<double> below = luminance_row(map, static_cast<int>(j) + 1);
    const double sum = make_distribution(blur_rows(above, row, below), &columns[j * (width + 1)]);
    // Solid angle of a texel: 2 pi / width (cos upper edge - cos lower edge).
    const double half_row = 0.25 / static_cast<double>(height);  // turns
    rows[j] = sum * 4 * kPi / static_cast<double>(width) * sin_cos_of_turns(half_row).sin *
              sin_cos_of_turns(half_row * (2 * static_cast<double>(j) + 1)).sin;
    above = std::move(row);
    row = std::move(below);
  }
  std::vector<double> row_distribution(height + 1);
  const double total = make_distribution(rows, row_distribution.data());
  if (!(total > 0)) return 0;
  const SinCos turn = sin_cos_of_turns(map.turns);
  const auto cosine = static_cast<float>(turn.cos), sine = static_cast<float>(turn.sin);
  scene.environment_texels = std::move(map.texels);
  scene.environment_rows = std::move(row_distribution);
  scene.environment_columns = std::move(columns);
  scene.environment_width = map.width;
  scene.environment_height = map.height;
  scene.environment_x = {cosine, 0, -sine};
  scene.environment_y = {0, 1, 0};
  scene.environment_z = {sine, 0, cosine};
  return total;
}

}  // namespace phalanx
