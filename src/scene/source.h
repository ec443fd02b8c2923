// One scene file being read: where its problems go, with the place of each.
#pragma once
#include <string>
#include <utility>

#include "../core/error.h"
#include "json_value.h"

namespace phalanx {

/// A value of the file with its JSON pointer.
struct Node {
  const JsonValue *value = nullptr;  // never null
  std::string path;

  Node item(std::size_t index) const { return {&value->items()[index], item_path(path, index)}; }
};

class Source {
 public:
  Source(std::string file, Diagnostics &diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  const std::string &file() const { return file_; }
  Diagnostics &diagnostics() { return diagnostics_; }
  /// Errors that this file got so far, also those that Diagnostics no longer keeps.
  int num_errors() const { return num_errors_; }

  void error(int line, int column, std::string path, std::string message) {
    num_errors_++;
    diagnostics_.error({file_, line, column, std::move(path), std::move(message)});
  }
  void error(const Node &at, std::string message) {
    error(at.value->line, at.value->column, at.path, std::move(message));
  }
  void warn(const Node &at, std::string message) {
    diagnostics_.warn({file_, at.value->line, at.value->column, at.path, std::move(message)});
  }
  /// The message of a value that is not what it should be.
  void expected(const Node &at, const std::string &what) {
    error(at, "expected " + what + ", found " + describe(*at.value));
  }

 private:
  std::string file_;
  Diagnostics &diagnostics_;
  int num_errors_ = 0;
};

}  // namespace phalanx
