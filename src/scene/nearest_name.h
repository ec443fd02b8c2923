// "did you mean ...?": the known name that a misspelt one is closest to.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace phalanx {

/// The name among `known` with the fewest single-letter edits (insert, delete, replace, swap of
/// neighbours; case does not count), if they are few for the length of the word; else "".
std::string nearest_name(std::string_view word, const std::vector<std::string> &known);

/// "; did you mean 'x'?" for the nearest name, "" if nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string> &known);

}  // namespace phalanx
