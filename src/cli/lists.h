// Lists on the command line: words and whole numbers.
#pragma once
#include <string>
#include <vector>

#include "../plan/options.h"

namespace phalanx {

std::vector<std::string> words(const std::string &text, char separator);

/// Whole numbers of at least `lo`; none if `text` is anything else.
std::vector<int> ints(const std::string &text, char separator, int lo);

/// Throws InputError.
[[noreturn]] void bad_value(const char *option, const char *expected, const std::string &found);

/// Throw InputError for what is not a list of schedules; for what is not WIDTHxHEIGHT.
std::vector<Mode> modes_from_list(const std::string &text);
void read_size(const std::string &text, RenderOptions &options);

}  // namespace phalanx
