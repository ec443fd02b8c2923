// Running means of blocks of samples.
#include "replicates.h"

#include <cassert>

namespace phalanx {

Replicates::Replicates(Rect crop, int count)
    : crop_(crop), count_(count), means_(static_cast<std::size_t>(num_pixels() * count * 3), 0.0f) {
  assert(count >= 2);
}

void Replicates::add_samples(int x, int y, int replicate, const float *samples, int num,
                             std::int64_t before) {
  double sum[3] = {0, 0, 0};
  int valid = 0;
  for (int i = 0; i < num; ++i) {
    const float *s = samples + 3 * i;
    if (!is_finite(s[0]) || !is_finite(s[1]) || !is_finite(s[2])) continue;
    for (int c = 0; c < 3; ++c) sum[c] += double{s[c]};
    ++valid;
  }
  if (valid == 0) return;
  const std::int64_t pixel = std::int64_t{y - crop_.y} * crop_.width + (x - crop_.x);
  float *mean = &means_[static_cast<std::size_t>((pixel * count_ + replicate) * 3)];
  const double weight = static_cast<double>(num) / static_cast<double>(before + num);
  for (int c = 0; c < 3; ++c)
    mean[c] = static_cast<float>(double{mean[c]} + (sum[c] / valid - double{mean[c]}) * weight);
}

}  // namespace phalanx
