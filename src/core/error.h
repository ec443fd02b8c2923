// How things go wrong, and what the shell is told.
//
// A user's mistake is a value with place, cause and remedy; all mistakes of one file are reported
// together. Anything that stops the program is one of these exceptions, caught once in main().
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace phalanx {

/// Exit codes: a contract that scripts rely on.
enum ExitCode {
  kExitDone = 0,
  kExitBadInput = 2,        // command line or scene
  kExitInvalidSamples = 3,  // under --strict
  kExitOutOfMemory = 4,
  kExitCannotWrite = 5,
  kExitBitsDiffer = 6,      // compare, replay: a schedule that must equal depth-first does not
  kExitCheckFailed = 7,     // check: a case failed
};

/// One problem in an input file. Printed as `file:line:column: /json/path: message`, leaving out
/// what is not known (line 0, empty path).
struct Problem {
  std::string file;
  int line = 0;
  int column = 0;
  std::string json_path;  // RFC 6901 pointer, e.g. /materials/2/ior
  std::string message;    // what was expected, what was found, the nearest known key

  std::string text() const;
};

/// The command line or an input file cannot be used. Carries every problem found, at least one.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  explicit InputError(const std::string &message);
  const std::vector<Problem> &problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// An output could not be written; whatever stood there before is intact.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What was asked for does not fit in memory.
class MemoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Collects problems while a file is read, so that one run shows them all (at most 20 are kept).
class Diagnostics {
 public:
  void error(Problem problem);
  void warn(Problem problem);
  bool has_errors() const { return num_errors_ > 0; }
  const std::vector<Problem> &errors() const { return errors_; }
  const std::vector<Problem> &warnings() const { return warnings_; }
  /// Throws InputError with all errors, if there are any.
  void throw_if_errors() const;

 private:
  std::vector<Problem> errors_;
  std::vector<Problem> warnings_;
  int num_errors_ = 0;
};

}  // namespace phalanx
