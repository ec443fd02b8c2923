// Numbers for people.
#pragma once
#include <cstdint>
#include <string>

#include "../core/error.h"

namespace phalanx {

/// "512 B", "1.5 KiB", "3.2 GiB".
std::string text_of_bytes(std::int64_t bytes);

/// "3.1e-3"; "?" for NaN.
std::string text_of_error(double error);

/// "1e-3", "2.5e-4": with as many digits as it takes.
std::string text_of_target(double error);

/// One line a problem on stderr: `phalanx: PREFIXfile:line:column: ...`.
void print_problems(const std::vector<Problem> &problems, const std::string &prefix = "");

}  // namespace phalanx
