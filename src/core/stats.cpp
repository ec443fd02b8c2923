#include "stats.h"

#include <algorithm>

namespace phalanx {

double imbalance(const std::vector<RankStats> &ranks) {
  double sum = 0, largest = 0;
  int count = 0;
  for (const RankStats &r : ranks) {
    if (r.lost) continue;
    sum += r.busy_s;
    largest = std::max(largest, r.busy_s);
    ++count;
  }
  return sum > 0 ? largest * count / sum : 1;
}

}  // namespace phalanx
