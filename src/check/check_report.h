// What the suite found, for people and for programs.
#pragma once
#include <string>
#include <vector>

#include "check.h"

namespace phalanx::check {

/// One line: verdict, id, title, the finding that says most, seconds. Failures and cases that do not apply have more.
std::string result_text(const CaseResult &result);
/// How many passed, failed, do not apply; invalid samples; seconds.
std::string summary_text(const std::vector<CaseResult> &results, double seconds);
std::string results_json(const std::vector<CaseResult> &results, const Options &options, double seconds);
/// A page without anything from elsewhere: tables that open.
std::string results_html(const std::vector<CaseResult> &results, const Options &options, double seconds);

}  // namespace phalanx::check
