// The numbers of JSON: RFC 8259, section 6.
#pragma once
#include <string>
#include <string_view>

namespace phalanx {

/// Reads `word`, which must be a JSON number as a whole, into `number`. Numbers too small for a
/// double become 0. Returns what is wrong, for a message, or an empty string.
std::string read_json_number(std::string_view word, double &number);

}  // namespace phalanx
