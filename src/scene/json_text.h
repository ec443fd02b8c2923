// From text to tree: a strict JSON reader (RFC 8259) that remembers positions.
//
// Stricter than most: a duplicate key, a number beyond the range of double, invalid UTF-8, nesting
// deeper than 64 and anything after the value are errors. Numbers too small for a double become 0.
#pragma once
#include <string_view>

#include "source.h"

namespace phalanx {

constexpr int kMaxJsonDepth = 64;

/// Reads `text` into `root`, which refers to `text`. Syntax is given up at the first error;
/// duplicate keys are reported all and reading goes on. Returns false if there is no usable tree.
bool parse_json(std::string_view text, Source &source, JsonValue &root);

}  // namespace phalanx
