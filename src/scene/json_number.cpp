#include "json_number.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "json_value.h"

namespace phalanx {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Length of the JSON number that `word` starts with, 0 if there is none.
std::size_t number_length(std::string_view word) {
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t start = i;
    while (i < word.size() && is_digit(word[i])) i++;
    return i - start;
  };
  if (i < word.size() && word[i] == '-') i++;
  const bool leading_zero = i < word.size() && word[i] == '0';
  const std::size_t num_digits = digits();
  if (num_digits == 0 || (leading_zero && num_digits > 1)) return 0;
  if (i < word.size() && word[i] == '.') {
    i++;
    if (digits() == 0) return 0;
  }
  if (i < word.size() && (word[i] == 'e' || word[i] == 'E')) {
    i++;
    if (i < word.size() && (word[i] == '+' || word[i] == '-')) i++;
    if (digits() == 0) return 0;
  }
  return i;
}

/// Whether a number beyond the range of double is too large, rather than too close to zero: the
/// decimal exponent of its first digit that is not 0 is positive.
bool is_huge(std::string_view number) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  const std::string_view mantissa = number.substr(0, e);
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  double exponent = static_cast<double>(point) - static_cast<double>(first);
  if (e < number.size()) {
    double written = 0;
    for (const char c : number.substr(e + 1)) {
      if (is_digit(c)) written = written * 10 + (c - '0');
    }
    exponent += number[e + 1] == '-' ? -written : written;
  }
  return exponent > 0;
}

std::string hint(std::string_view word) {
  const std::size_t letter = word.find_first_of("IiNn");
  if (letter != std::string_view::npos) return "; every number must be finite";
  if (word.starts_with('+')) return "; leave out the '+'";
  if (word.starts_with('.') || word.starts_with("-.")) return "; write a digit before the point";
  if (word.ends_with('.')) return "; write a digit after the point";
  if (word.size() > 1 && word[0] == '0') return "; leave out the leading 0";
  return "";
}

}  // namespace

std::string read_json_number(std::string_view word, double &number) {
  const std::size_t length = number_length(word);
  if (length == 0 || length != word.size())
    return "not a JSON number: '" + printable(word) + "'" + hint(word);
  const auto result = std::from_chars(word.data(), word.data() + word.size(), number);
  if (result.ec == std::errc::result_out_of_range) {
    if (is_huge(word))
      return "the number " + printable(word) + " is too large (the limit is 1.8e308)";
    number = 0;
  }
  return "";
}

}  // namespace phalanx
