// Choosing one of many in constant time, with given probabilities.
#pragma once
#include <cstdint>
#include <vector>

namespace phalanx {

/// Choose entry i with two uniforms u, v in [0,1): i = floor(u * n), then i if v < threshold[i],
/// else other[i]. A. Walker 1977; built by M. Vose's method (IEEE Trans. Software Eng. 17:9, 1991).
struct AliasTable {
  std::vector<float> threshold;     // [n] in [0,1]
  std::vector<std::int32_t> other;  // [n]
  std::vector<double> probability;  // [n] what the rounded table really gives; sums to 1
};

/// Probabilities proportional to `weights`: finite, >= 0, at most 2^31 - 1 of them. Entries of
/// weight 0 are never chosen. Sums are in double: a light of weight 1 beside 10^5 of 1e-8 does not
/// swallow them. If all weights are 0 or there are none, the table is empty.
AliasTable make_alias_table(const std::vector<double> &weights);

}  // namespace phalanx
