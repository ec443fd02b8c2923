#include "check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "../report/version.h"

namespace phalanx::check {
namespace {

using Json = nlohmann::ordered_json;

int num_with(const std::vector<CaseResult> &results, Verdict verdict) {
  return static_cast<int>(std::count_if(results.begin(), results.end(),
                                        [&](const CaseResult &r) { return r.verdict == verdict; }));
}

std::int64_t num_invalid(const std::vector<CaseResult> &results) {
  std::int64_t sum = 0;
  for (const CaseResult &r : results) sum += r.invalid_samples;
  return sum;
}

std::string interval_text(const Finding &f) {
  if (f.lo == f.hi) return fmt::format("{:.8g}", f.lo);
  if (std::isinf(f.lo)) return fmt::format("at most {:.4g}", f.hi);
  if (std::isinf(f.hi)) return fmt::format("at least {:.4g}", f.lo);
  return fmt::format("{:.6g} to {:.6g}", f.lo, f.hi);
}

std::string finding_text(const Finding &f) {
  return fmt::format("{}: {:.8g}, accepted {}{}", f.what, f.measured, interval_text(f),
                     f.note.empty() || f.passed() ? "" : " (" + f.note + ")");
}

std::vector<std::string> mode_names(const Options &options) {
  std::vector<std::string> names;
  for (const Mode mode : options.modes) names.push_back(mode_name(mode));
  return names;
}

Json finding_json(const Finding &f) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  return {{"what", f.what},         {"expected", number(f.expected)}, {"measured", number(f.measured)},
          {"lo", number(f.lo)},     {"hi", number(f.hi)},             {"passed", f.passed()},
          {"note", f.note}};
}

std::string escaped(const std::string &text) {
  std::string result;
  for (const char ch : text) {
    if (ch == '<') result += "&lt;";
    else if (ch == '>') result += "&gt;";
    else if (ch == '&') result += "&amp;";
    else result += ch;
  }
  return result;
}

const char kStyle[] =
    "body{font:15px/1.45 sans-serif;margin:2em auto;max-width:70em;padding:0 1em}"
    "table{border-collapse:collapse;width:100%;margin:.5em 0 1em}"
    "td,th{text-align:left;padding:.2em .6em;border-bottom:1px solid #ddd;vertical-align:top}"
    "summary{cursor:pointer;padding:.25em 0}.passed{color:#176b2c}.failed{color:#b00020;font-weight:bold}"
    ".na{color:#777}.n{font-variant-numeric:tabular-nums;white-space:nowrap}";

}  // namespace

std::string result_text(const CaseResult &r) {
  std::string text = fmt::format("{:<8}{:<5}{:<58}{:>8.2f} s\n",
                                 r.verdict == Verdict::kNotApplicable ? "n/a" : verdict_name(r.verdict), r.id, r.title,
                                 r.seconds);
  if (!r.reason.empty()) text += fmt::format("             {}\n", r.reason);
  if (r.verdict == Verdict::kFailed) {
    int shown = 0;
    for (const Finding &f : r.findings)
      if (!f.passed() && ++shown <= 5) text += fmt::format("             {}\n", finding_text(f));
    const auto all = std::count_if(r.findings.begin(), r.findings.end(), [](const Finding &f) { return !f.passed(); });
    if (all > 5) text += fmt::format("             and {} more\n", all - 5);
  } else if (const Finding *worst = r.worst()) {
    text += fmt::format("             {} findings; closest to its bounds: {}\n", r.findings.size(), finding_text(*worst));
  }
  return text;
}

std::string summary_text(const std::vector<CaseResult> &results, double seconds) {
  std::size_t findings = 0;
  for (const CaseResult &r : results) findings += r.findings.size();
  return fmt::format("{} cases: {} passed, {} failed, {} not applicable; {} findings, {} invalid samples, {:.1f} s\n",
                     results.size(), num_with(results, Verdict::kPassed), num_with(results, Verdict::kFailed),
                     num_with(results, Verdict::kNotApplicable), findings, num_invalid(results), seconds);
}

std::string results_json(const std::vector<CaseResult> &results, const Options &options, double seconds) {
  Json cases = Json::array();
  for (const CaseResult &r : results) {
    Json findings = Json::array();
    for (const Finding &f : r.findings) findings.push_back(finding_json(f));
    cases.push_back({{"id", r.id},
                     {"group", r.group},
                     {"title", r.title},
                     {"verdict", verdict_name(r.verdict)},
                     {"reason", r.reason},
                     {"remarks", r.remarks},
                     {"invalid_samples", r.invalid_samples},
                     {"seconds", r.seconds},
                     {"findings", findings}});
  }
  const Json json = {{"version", version()},
                     {"quick", options.quick},
                     {"isas", options.isas},
                     {"modes", mode_names(options)},
                     {"passed", num_with(results, Verdict::kPassed)},
                     {"failed", num_with(results, Verdict::kFailed)},
                     {"not_applicable", num_with(results, Verdict::kNotApplicable)},
                     {"invalid_samples", num_invalid(results)},
                     {"seconds", seconds},
                     {"cases", cases}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string results_html(const std::vector<CaseResult> &results, const Options &options, double seconds) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>phalanx check</title>"
      "<style>{}</style></head><body>\n<h1>Stability suite</h1>\n<p>phalanx {}, {}; instruction sets {}; schedules "
      "{}.</p>\n<p>{}</p>\n",
      kStyle, escaped(version()), options.quick ? "quick" : "full", fmt::join(options.isas, ", "),
      fmt::join(mode_names(options), ", "), escaped(summary_text(results, seconds)));
  std::string group;
  for (const CaseResult &r : results) {
    if (r.group != group) html += fmt::format("<h2>{}</h2>\n", escaped(group = r.group));
    const char *colour = r.verdict == Verdict::kPassed ? "passed" : r.verdict == Verdict::kFailed ? "failed" : "na";
    html += fmt::format("<details{}><summary><span class=\"{}\">{}</span> <b>{}</b> {} <span class=\"n\">({:.2f} s)</span></summary>\n",
                        r.verdict == Verdict::kFailed ? " open" : "", colour, verdict_name(r.verdict), escaped(r.id),
                        escaped(r.title), r.seconds);
    if (!r.reason.empty()) html += "<p>" + escaped(r.reason) + "</p>\n";
    for (const std::string &remark : r.remarks) html += "<p>Note: " + escaped(remark) + ".</p>\n";
    if (!r.findings.empty()) {
      html += "<table><tr><th>what</th><th>expected</th><th>measured</th><th>accepted</th><th></th></tr>\n";
      for (const Finding &f : r.findings)
        html += fmt::format(
            "<tr><td>{}{}</td><td class=\"n\">{}</td><td class=\"n\">{:.8g}</td><td class=\"n\">{}</td><td class=\"{}\">{}</td></tr>\n",
            escaped(f.what), f.note.empty() ? "" : " <small>" + escaped(f.note) + "</small>",
            std::isnan(f.expected) ? "" : fmt::format("{:.8g}", f.expected), f.measured, interval_text(f),
            f.passed() ? "passed" : "failed", f.passed() ? "passed" : "failed");
      html += "</table>\n";
    }
    html += "</details>\n";
  }
  return html + "</body></html>\n";
}

}  // namespace phalanx::check
