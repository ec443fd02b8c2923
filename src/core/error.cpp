#include "error.h"

#include <cassert>
#include <utility>

namespace phalanx {

namespace {

constexpr int kMaxProblemsKept = 20;

std::string joined_text(const std::vector<Problem> &problems) {
  std::string text;
  for (const Problem &problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.text();
  }
  return text;
}

void keep_if_room(std::vector<Problem> &kept, Problem problem) {
  if (kept.size() < kMaxProblemsKept) kept.push_back(std::move(problem));
}

}  // namespace

std::string Problem::text() const {
  std::string text = file;
  if (line > 0) text += ':' + std::to_string(line);
  if (line > 0 && column > 0) text += ':' + std::to_string(column);
  if (!json_path.empty()) text += (text.empty() ? "" : ": ") + json_path;
  if (!message.empty()) text += (text.empty() ? "" : ": ") + message;
  return text;
}

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(joined_text(problems)), problems_(std::move(problems)) {
  assert(!problems_.empty());
}

InputError::InputError(const std::string &message)
    : InputError(std::vector<Problem>{Problem{"", 0, 0, "", message}}) {}

void Diagnostics::error(Problem problem) {
  num_errors_++;
  keep_if_room(errors_, std::move(problem));
}

void Diagnostics::warn(Problem problem) { keep_if_room(warnings_, std::move(problem)); }

void Diagnostics::throw_if_errors() const {
  if (!has_errors()) return;
  std::vector<Problem> problems = errors_;
  const int num_dropped = num_errors_ - static_cast<int>(errors_.size());
  if (num_dropped > 0) {
    Problem rest;
    rest.file = errors_.back().file;
    rest.message =
        "and " + std::to_string(num_dropped) + " more error" + (num_dropped > 1 ? "s" : "");
    problems.push_back(rest);
  }
  throw InputError(std::move(problems));
}

}  // namespace phalanx
