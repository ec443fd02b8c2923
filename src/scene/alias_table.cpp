#include "alias_table.h"

#include <algorithm>

namespace phalanx {

using std::size_t;

AliasTable make_alias_table(const std::vector<double> &weights) {
  const size_t n = weights.size();
  const auto heaviest = std::max_element(weights.begin(), weights.end());
  if (n == 0 || !(*heaviest > 0)) return {};
  const auto heaviest_id = static_cast<std::int32_t>(heaviest - weights.begin());
  double sum = 0;  // of weights relative to the heaviest: cannot overflow
  for (const double weight : weights) sum += weight / *heaviest;

  // Everyone's share of the n columns of height 1; the poor fill theirs up from the rich.
  std::vector<double> share(n);
  std::vector<std::int32_t> poor, rich;
  for (size_t i = 0; i < n; ++i) {
    share[i] = weights[i] / *heaviest / sum * static_cast<double>(n);
    (share[i] < 1.0 ? poor : rich).push_back(static_cast<std::int32_t>(i));
  }
  AliasTable table;
  table.threshold.assign(n, 1.0f);
  table.other.assign(n, heaviest_id);
  while (!poor.empty() && !rich.empty()) {
    const auto from = static_cast<size_t>(rich.back()), to = static_cast<size_t>(poor.back());
    poor.pop_back();
    table.threshold[to] = static_cast<float>(share[to]);
    table.other[to] = static_cast<std::int32_t>(from);
    share[from] -= 1.0 - static_cast<double>(table.threshold[to]);
    if (share[from] < 1.0) {
      rich.pop_back();
      poor.push_back(static_cast<std::int32_t>(from));
    }
  }
  // What is left has a share of 1 but for rounding; only weight 0 must not be chosen.
  for (const std::int32_t i : poor)
    if (!(weights[static_cast<size_t>(i)] > 0)) table.threshold[static_cast<size_t>(i)] = 0.0f;

  table.probability.assign(n, 0.0);
  const double column = 1.0 / static_cast<double>(n);
  for (size_t i = 0; i < n; ++i) {
    table.probability[i] += column * static_cast<double>(table.threshold[i]);
    table.probability[static_cast<size_t>(table.other[i])] +=
        column * (1.0 - static_cast<double>(table.threshold[i]));
  }
  return table;
}

}  // namespace phalanx
