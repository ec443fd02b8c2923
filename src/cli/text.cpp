// Short forms of numbers.
#include "text.h"

#include <fmt/format.h>

#include <cmath>

namespace phalanx {

std::string text_of_bytes(std::int64_t bytes) {
  if (bytes < 1024) return fmt::format("{} B", bytes);
  double value = static_cast<double>(bytes) / 1024;
  const char *const units[] = {"KiB", "MiB", "GiB", "TiB"};
  int unit = 0;
  for (; value >= 1024 && unit < 3; unit++) value /= 1024;
  return fmt::format("{:.1f} {}", value, units[unit]);
}

std::string text_of_error(double error) {
  if (std::isnan(error)) return "?";
  if (error == 0) return "0";
  std::string text = fmt::format("{:.1e}", error);
  const std::size_t exponent = text.find('e');  // 3.1e-03 becomes 3.1e-3
  if (exponent != std::string::npos && text.size() == exponent + 4 && text[exponent + 2] == '0')
    text.erase(exponent + 2, 1);
  return text;
}

std::string text_of_target(double error) {
  std::string text = fmt::format("{:e}", error);
  std::size_t e = text.find('e');
  while (text[e - 1] == '0') text.erase(--e, 1);
  if (text[e - 1] == '.') text.erase(--e, 1);
  if (text.size() == e + 4 && text[e + 2] == '0') text.erase(e + 2, 1);
  return text;
}

void print_problems(const std::vector<Problem> &problems, const std::string &prefix) {
  for (const Problem &problem : problems)
    fmt::print(stderr, "phalanx: {}{}\n", prefix, problem.text());
}

}  // namespace phalanx
