// The stability suite: stiff and extreme cases with known answers, run on the user's machine.
//
// A case is a function that renders scenes, or calls the physics, and notes findings: what was measured and
// the interval in which it has to lie. Scenes are made in code; nothing is read from the disk.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "../plan/options.h"

namespace phalanx::check {

/// One comparison. It passes if lo <= measured <= hi.
struct Finding {
  std::string what;
  double expected = 0;      // NaN where only a bound is known
  double measured = 0;
  double lo = 0, hi = 0;
  std::string note;         // a message that was expected, or what else helps to understand

  bool passed() const { return measured >= lo && measured <= hi; }
};

enum class Verdict { kPassed, kFailed, kNotApplicable };
const char *verdict_name(Verdict verdict);  // "passed", "failed", "not applicable"

struct CaseResult {
  std::string id, group, title;
  Verdict verdict = Verdict::kFailed;
  std::string reason;              // why it does not apply, or the error that ended it
  std::vector<std::string> remarks;  // what the case leaves out
  std::vector<Finding> findings;
  std::int64_t invalid_samples = 0;  // of all its renderings
  double seconds = 0;

  /// The finding to show for all: the first that failed, else the one closest to its bounds. nullptr: none.
  const Finding *worst() const;
};

class Case;

/// A line of the catalogue.
struct CaseInfo {
  const char *id;
  const char *title;               // what is tested
  void (*run)(Case &) = nullptr;   // nullptr: it does not apply, and `reason` says why
  const char *reason = "";
  bool alone = false;              // measures times: nothing else may run beside it
};

/// Cases of one group, in the order of the catalogue.
struct Group {
  const char *name;
  std::vector<CaseInfo> cases;
};

/// The catalogue: scale, geometry, materials, lights, media, sampling, camera.
const std::vector<Group> &catalogue();

struct Options {
  bool quick = false;              // fewer samples, wider intervals
  std::vector<std::string> isas;   // instruction sets to run, not empty
  std::vector<Mode> modes;         // the first measures, the others must agree with it; not empty
  int threads = 1;                 // cases at a time, at least 1
};

/// Runs the groups and cases that `wanted` accepts (given group and id), in order; `done` is called after each
/// case by one thread at a time. Results are in the order of the catalogue.
std::vector<CaseResult> run_checks(const std::vector<Group> &groups, const Options &options,
                                   const std::function<bool(const Group &, const CaseInfo &)> &wanted,
                                   const std::function<void(const CaseResult &)> &done);

int num_failed(const std::vector<CaseResult> &results);

}  // namespace phalanx::check
