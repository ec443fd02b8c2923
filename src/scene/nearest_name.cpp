#include "nearest_name.h"

#include <algorithm>
#include <cctype>

namespace phalanx {

namespace {

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Optimal string alignment distance, three rows at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); j++) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); i++) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); j++) {
      const std::size_t replace = last[j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({replace, last[j] + 1, row[j - 1] + 1});
      const bool swapped =
          i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string> &known) {
  constexpr std::size_t kMaxLength = 100;  // nobody mistypes a longer word; bounds the work
  if (word.size() > kMaxLength) return "";
  std::string nearest;
  std::size_t fewest = 1 + word.size() / 4;  // edits that may still be a slip
  for (const std::string &name : known) {
    if (name.size() > kMaxLength) continue;
    const std::size_t distance = edit_distance(word, name);
    if (distance >= std::min(word.size(), name.size())) continue;  // nothing in common
    if (distance < fewest || (distance == fewest && nearest.empty())) {
      nearest = name;
      fewest = distance;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string> &known) {
  const std::string nearest = nearest_name(word, known);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace phalanx
