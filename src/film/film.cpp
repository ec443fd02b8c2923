// Running mean and variance of every pixel, by Welford's recurrence.
//
// One sample at a time: the rounding of a pixel is then a function of its samples in their order and
// of nothing else. Merging whole passes (Chan et al. 1979) would be a little faster, but a picture
// of 64 + 64 samples would differ in its last bits from one of 128.
#include "film.h"

#include <cassert>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace phalanx {

void InvalidSamples::add(int pixel_x, int pixel_y, std::int64_t sample_number, Kind kind) {
  InvalidSamples one;
  one.count = 1;
  one.x = pixel_x;
  one.y = pixel_y;
  one.sample = sample_number;
  (kind == Kind::kNegative ? one.negative : one.not_finite) = 1;
  merge(one);
}

void InvalidSamples::merge(const InvalidSamples &other) {
  clamped += other.clamped;
  clamped_energy += other.clamped_energy;
  if (other.count == 0) return;
  const bool other_is_earlier =
      count == 0 || std::tie(other.sample, other.y, other.x) < std::tie(sample, y, x);
  if (other_is_earlier) {
    x = other.x;
    y = other.y;
    sample = other.sample;
  }
  count += other.count;
  not_finite += other.not_finite;
  negative += other.negative;
}

Film::Film(Rect crop, bool with_aovs)
    : crop_(crop), moments_(num_pixels()), counts_(num_pixels(), 0) {
  if (with_aovs) first_hits_.resize(num_pixels());
}

std::int64_t Film::bytes_per_pixel(bool with_aovs) {
  return sizeof(Moments) + sizeof(std::int64_t) + (with_aovs ? sizeof(FirstHit) : 0);
}

std::int64_t Film::index(int x, int y) const {
  assert(x >= crop_.x && x < crop_.x + crop_.width && y >= crop_.y && y < crop_.y + crop_.height);
  return std::int64_t{y - crop_.y} * crop_.width + (x - crop_.x);
}

namespace {

/// The sample scaled so that its largest channel is `limit`: dimmer, of the same colour.
Vec3 clamped(Vec3 sample, float limit, InvalidSamples &counts) {
  const Vec3 cut = sample * (limit / max_component(sample));
  counts.clamped += 1;
  for (const auto &[before, after] : {std::pair{sample.x, cut.x}, {sample.y, cut.y}, {sample.z, cut.z}})
    counts.clamped_energy += (double{before} - double{after}) / 3;
  return cut;
}

}  // namespace

double Film::energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < moments_.size(); ++i)
    sum += (moments_[i].mean[0] + moments_[i].mean[1] + moments_[i].mean[2]) / 3 * static_cast<double>(counts_[i]);
  return sum;
}

void Film::add_samples(int x, int y, const float *samples, int count, std::int64_t first_sample,
                       InvalidSamples &invalid) {
  const std::int64_t pixel = index(x, y);
  Moments moments = moments_[pixel];  // a local copy stays in registers
  std::int64_t n = counts_[pixel];
  for (int i = 0; i < count; i++) {
    Vec3 sample = {samples[3 * std::int64_t{i}], samples[3 * std::int64_t{i} + 1], samples[3 * std::int64_t{i} + 2]};
    if (!all_finite(sample)) {
      invalid.add(x, y, first_sample + i);
      continue;
    }
    if (sample.x < 0 || sample.y < 0 || sample.z < 0) {
      invalid.add(x, y, first_sample + i, InvalidSamples::Kind::kNegative);
      continue;
    }
    if (clamp_ > 0 && max_component(sample) > clamp_) sample = clamped(sample, clamp_, invalid);
    const float channels[] = {sample.x, sample.y, sample.z};
    n++;
    const double weight = 1.0 / static_cast<double>(n);
    for (int c = 0; c < 3; c++) {
      const double value = double{channels[c]};
      const double from_old_mean = value - moments.mean[c];
      moments.mean[c] += from_old_mean * weight;
      moments.m2[c] += from_old_mean * (value - moments.mean[c]);
    }
  }
  moments_[pixel] = moments;
  counts_[pixel] = n;
}

void Film::add_aovs(int x, int y, const float *records, int count) {
  assert(has_aovs());
  FirstHit &sum = first_hits_[index(x, y)];
  for (int i = 0; i < count; i++) {
    const float *record = records + 7 * std::int64_t{i};
    bool finite = true;
    for (int k = 0; k < 7; k++) finite = finite && is_finite(record[k]);
    if (!finite) continue;
    for (int c = 0; c < 3; c++) {
      sum.albedo[c] += double{record[c]};
      sum.normal[c] += double{record[3 + c]};
    }
    sum.depth += double{record[6]};
    sum.hits += record[6] > 0 ? 1 : 0;
    sum.count++;
  }
}

namespace {

template <typename T>
void copy_rows_out(const std::vector<T> &plane, std::int64_t first, std::int64_t stride, Rect region,
                   std::byte *&out) {
  const std::size_t row = static_cast<std::size_t>(region.width) * sizeof(T);
  for (int y = 0; y < region.height; y++, out += row)
    std::memcpy(out, &plane[static_cast<std::size_t>(first + y * stride)], row);
}

template <typename T>
void copy_rows_in(std::vector<T> &plane, std::int64_t first, std::int64_t stride, Rect region,
                  const std::byte *&in) {
  const std::size_t row = static_cast<std::size_t>(region.width) * sizeof(T);
  for (int y = 0; y < region.height; y++, in += row)
    std::memcpy(&plane[static_cast<std::size_t>(first + y * stride)], in, row);
}

std::size_t bytes_of(Rect region, bool with_aovs) {
  return static_cast<std::size_t>(std::int64_t{region.width} * region.height *
                                  Film::bytes_per_pixel(with_aovs));
}

}  // namespace

std::vector<std::byte> Film::region_bytes(Rect region) const {
  std::vector<std::byte> bytes(bytes_of(region, has_aovs()));
  if (bytes.empty()) return bytes;
  const std::int64_t first = index(region.x, region.y);
  std::byte *out = bytes.data();
  copy_rows_out(moments_, first, crop_.width, region, out);
  copy_rows_out(counts_, first, crop_.width, region, out);
  if (has_aovs()) copy_rows_out(first_hits_, first, crop_.width, region, out);
  return bytes;
}

void Film::set_region(Rect region, std::span<const std::byte> bytes) {
  if (bytes.size() != bytes_of(region, has_aovs()))
    throw std::invalid_argument("a region of the film has another number of bytes");
  if (bytes.empty()) return;
  const std::int64_t first = index(region.x, region.y);
  const std::byte *in = bytes.data();
  copy_rows_in(moments_, first, crop_.width, region, in);
  copy_rows_in(counts_, first, crop_.width, region, in);
  if (has_aovs()) copy_rows_in(first_hits_, first, crop_.width, region, in);
}

namespace {

Vec3 scaled(const double v[3], double s) {
  return vec3(static_cast<float>(v[0] * s), static_cast<float>(v[1] * s),
              static_cast<float>(v[2] * s));
}

double one_over(std::int64_t n) { return n > 0 ? 1.0 / static_cast<double>(n) : 0.0; }

}  // namespace

double Film::image_mean() const {
  double sum = 0;
  for (std::int64_t i = 0; i < num_pixels(); ++i) {
    const Vec3 m = mean(i);
    sum += double{m.x} + double{m.y} + double{m.z};
  }
  return sum / (3.0 * static_cast<double>(num_pixels()));
}

Vec3 Film::mean(std::int64_t pixel) const { return scaled(moments_[pixel].mean, 1.0); }

Vec3 Film::variance_of_mean(std::int64_t pixel) const {
  const std::int64_t n = counts_[pixel];
  if (n < 2) {
    const float unknown = std::numeric_limits<float>::infinity();
    return vec3(unknown, unknown, unknown);
  }
  return scaled(moments_[pixel].m2, one_over(n) * one_over(n - 1));
}

Vec3 Film::albedo(std::int64_t pixel) const {
  return scaled(first_hits_[pixel].albedo, one_over(first_hits_[pixel].count));
}

Vec3 Film::normal(std::int64_t pixel) const {
  return scaled(first_hits_[pixel].normal, one_over(first_hits_[pixel].count));
}

float Film::depth(std::int64_t pixel) const {
  return static_cast<float>(first_hits_[pixel].depth * one_over(first_hits_[pixel].hits));
}

}  // namespace phalanx
