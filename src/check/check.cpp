#include "check.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "../core/parallel.h"
#include "../core/timer.h"
#include "case.h"
#include "groups.h"

namespace phalanx::check {

const char *verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPassed: return "passed";
    case Verdict::kFailed: return "failed";
    default: return "not applicable";
  }
}

namespace {

/// How much of the way from the middle of its interval to the bound a finding has gone; above 1: failed.
double strain(const Finding &f) {
  if (!f.passed()) return std::isnan(f.measured) ? 1e300 : 2;
  if (std::isnan(f.expected)) {
    if (std::isfinite(f.lo) && std::isfinite(f.hi) && f.hi > f.lo)
      return std::fabs(f.measured - 0.5 * (f.lo + f.hi)) / (0.5 * (f.hi - f.lo));
    return std::isfinite(f.hi) && f.hi > 0 ? f.measured / f.hi : 0.01;
  }
  return f.hi > f.expected ? std::fabs(f.measured - f.expected) / (f.hi - f.expected) : 0;
}

CaseResult run_case(const Group &group, const CaseInfo &info, const Options &options) {
  CaseResult result;
  result.id = info.id;
  result.group = group.name;
  result.title = info.title;
  if (info.run == nullptr) {
    result.verdict = Verdict::kNotApplicable;
    result.reason = info.reason;
    return result;
  }
  const double start = wall_seconds();
  Case c(options, result);
  try {
    info.run(c);
    c.finish();
  } catch (const std::exception &error) {
    result.reason = error.what();
  }
  const bool all_pass = std::all_of(result.findings.begin(), result.findings.end(),
                                    [](const Finding &f) { return f.passed(); });
  // A case that measured nothing has shown nothing.
  if (all_pass && result.reason.empty() && !result.findings.empty()) result.verdict = Verdict::kPassed;
  result.seconds = wall_seconds() - start;
  return result;
}

}  // namespace

const Finding *CaseResult::worst() const {
  const auto less = [](const Finding &a, const Finding &b) { return strain(a) < strain(b); };
  const auto found = std::max_element(findings.begin(), findings.end(), less);
  return found == findings.end() ? nullptr : &*found;
}

std::vector<CaseResult> run_checks(const std::vector<Group> &groups, const Options &options,
                                   const std::function<bool(const Group &, const CaseInfo &)> &wanted,
                                   const std::function<void(const CaseResult &)> &done) {
  struct Job {
    const Group *group;
    const CaseInfo *info;
  };
  std::vector<Job> jobs;
  for (const Group &group : groups)
    for (const CaseInfo &info : group.cases)
      if (wanted(group, info)) jobs.push_back({&group, &info});

  std::vector<CaseResult> results(jobs.size());
  std::mutex mutex;
  const auto run = [&](std::size_t i) {
    results[i] = run_case(*jobs[i].group, *jobs[i].info, options);
    const std::lock_guard lock(mutex);
    done(results[i]);
  };
  // Threads of our own: cases open parallel regions, which OpenMP would not nest.
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    const FlushDenormals flush;
    for (std::size_t i = next++; i < jobs.size(); i = next++)
      if (!jobs[i].info->alone) run(i);
  };
  std::vector<std::thread> threads;
  for (int t = 1; t < options.threads; ++t) threads.emplace_back(work);
  work();
  for (std::thread &thread : threads) thread.join();
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (jobs[i].info->alone) run(i);
  return results;
}

const std::vector<Group> &catalogue() {
  static const std::vector<Group> groups = {scale_group(), geometry_group(), materials_group(), lights_group(),
                                            media_group(), sampling_group(), camera_group()};
  return groups;
}

int num_failed(const std::vector<CaseResult> &results) {
  return static_cast<int>(std::count_if(results.begin(), results.end(), [](const CaseResult &r) {
    return r.verdict == Verdict::kFailed;
  }));
}

}  // namespace phalanx::check
