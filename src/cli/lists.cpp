#include "lists.h"

#include <fmt/format.h>

#include <charconv>

#include "../core/error.h"

namespace phalanx {

std::vector<std::string> words(const std::string &text, char separator) {
  std::vector<std::string> result(1);
  for (const char c : text)
    if (c == separator)
      result.emplace_back();
    else
      result.back() += c;
  return result;
}

std::vector<int> ints(const std::string &text, char separator, int lo) {
  std::vector<int> values;
  for (const std::string &word : words(text, separator)) {
    int value = 0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (result.ec != std::errc() || result.ptr != word.data() + word.size() || value < lo)
      return {};
    values.push_back(value);
  }
  return values;
}

void bad_value(const char *option, const char *expected, const std::string &found) {
  throw InputError(fmt::format("{}: expected {}, found \"{}\"", option, expected, found));
}

std::vector<Mode> modes_from_list(const std::string &text) {
  std::vector<Mode> modes;
  for (const std::string &word : words(text, ',')) {
    const auto mode = mode_from_name(word);
    if (!mode)
      bad_value("--modes", "a list of wavefront, megakernel, depth-first, recursive", text);
    modes.push_back(*mode);
  }
  return modes;
}

void read_size(const std::string &text, RenderOptions &options) {
  const std::vector<int> size = ints(text, 'x', 1);
  if (size.size() != 2) bad_value("--size", "WIDTHxHEIGHT in pixels, such as 640x480", text);
  options.width = size[0];
  options.height = size[1];
}

}  // namespace phalanx
