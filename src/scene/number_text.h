// Reads one number of a text file, all of it or nothing.
#pragma once
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace phalanx {

enum class NumberText { kGood, kNotANumber, kNotFinite };

/// The value of `token`: decimal, with or without sign and exponent, nothing else around it.
/// kNotFinite: nan, inf, what is too large for a float or outside the range of a double (1e-400).
/// Does not look at the locale.
inline NumberText parse_number(std::string_view token, double &value) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  const char *const end = token.data() + token.size();
  value = 0;
  const auto result = std::from_chars(token.data(), end, value);
  if (result.ptr != end || result.ec == std::errc::invalid_argument) return NumberText::kNotANumber;
  if (result.ec == std::errc::result_out_of_range) return NumberText::kNotFinite;
  const double limit = std::numeric_limits<float>::max();
  return std::fabs(value) <= limit ? NumberText::kGood : NumberText::kNotFinite;
}

}  // namespace phalanx
