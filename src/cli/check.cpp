// phalanx check: the stability suite on this machine.
#include "../check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "../check/check_report.h"
#include "../core/error.h"
#include "../core/parallel.h"
#include "../core/timer.h"
#include "../output/files.h"
#include "../wavefront/isa.h"
#include "commands.h"

namespace phalanx {
namespace {

struct CheckCommand {
  std::vector<std::string> suites;
  std::string isa, mode, json, html;
  int threads = 0;
  bool quick = false, list = false;
};

std::vector<std::string> isas_to_run(const std::string &wanted) {
  if (!wanted.empty()) return {resolve_isa(wanted)};
  std::vector<std::string> isas;
  for (const std::string &isa : known_isas())
    if (isa_supported(isa)) isas.push_back(isa);
  if (isas.empty()) best_isa();  // says what is missing
  return isas;
}

std::vector<Mode> modes_to_run(const std::string &wanted) {
  if (wanted.empty()) return {Mode::kWavefront, Mode::kMegakernel, Mode::kDepthFirst, Mode::kRecursive};
  const auto mode = mode_from_name(wanted);
  if (!mode)
    throw InputError(
        fmt::format("--mode: expected wavefront, megakernel, depth-first or recursive, found \"{}\"", wanted));
  return {*mode};
}

bool is_named(const std::vector<std::string> &names, const std::string &name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Every name must be a group or a case.
void check_names(const std::vector<std::string> &names) {
  for (const std::string &name : names) {
    bool known = false;
    std::vector<std::string> groups;
    for (const check::Group &group : check::catalogue()) {
      groups.push_back(group.name);
      known = known || name == group.name;
      for (const check::CaseInfo &info : group.cases) known = known || name == info.id;
    }
    if (!known)
      throw InputError(fmt::format("unknown suite \"{}\"; suites are {}, or a case such as S1", name, fmt::join(groups, ", ")));
  }
}

int run_check(const CheckCommand &command) {
  check_names(command.suites);
  const auto wanted = [&](const check::Group &group, const check::CaseInfo &info) {
    return command.suites.empty() || is_named(command.suites, group.name) || is_named(command.suites, info.id);
  };
  if (command.list) {
    for (const check::Group &group : check::catalogue())
      for (const check::CaseInfo &info : group.cases)
        if (wanted(group, info)) fmt::print("{:<11}{:<5}{}\n", group.name, info.id, info.title);
    return kExitDone;
  }
  for (const std::string &path : {command.json, command.html})
    if (!path.empty() && path != "-") check_output_path(path);
  check::Options options;
  options.quick = command.quick;
  options.isas = isas_to_run(command.isa);
  options.modes = modes_to_run(command.mode);
  options.threads = command.threads > 0 ? command.threads : max_threads();

  const bool print_text = command.json != "-";
  const double start = wall_seconds();
  const std::vector<check::CaseResult> results =
      check::run_checks(check::catalogue(), options, wanted, [&](const check::CaseResult &result) {
        if (!print_text) return;
        fmt::print("{}", check::result_text(result));
        std::fflush(stdout);
      });
  const double seconds = wall_seconds() - start;
  if (print_text) fmt::print("{}", check::summary_text(results, seconds));
  std::fflush(stdout);
  if (!command.json.empty())
    write_file(command.json == "-" ? "/dev/stdout" : command.json, check::results_json(results, options, seconds));
  if (!command.html.empty()) write_file(command.html, check::results_html(results, options, seconds));
  return check::num_failed(results) > 0 ? kExitCheckFailed : kExitDone;
}

const char kExamples[] =
    "Suites: scale, geometry, materials, lights, media, sampling, camera, or single cases such as S1.\n"
    "Examples:\n"
    "  phalanx check --quick\n"
    "  phalanx check scale G5 --isa avx2\n"
    "  phalanx check --json check.json --html check.html\n"
    "Exit codes: 0 all cases that apply passed, 2 bad command line, 5 cannot write, 7 a case failed.";

}  // namespace

void add_check_command(CLI::App &app, int &exit_code) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App *sub = app.add_subcommand("check", "Run stiff and extreme cases with known answers");
  sub->add_option("SUITE", command->suites, "Groups or cases to run; all by default");
  sub->add_flag("--quick", command->quick, "Fewer samples: less than a minute instead of a quarter of an hour");
  sub->add_flag("--list", command->list, "Print the cases and run none");
  sub->add_option("--isa", command->isa, "Instruction set; by default every one that this machine has")->type_name("NAME");
  sub->add_option("--mode", command->mode, "Schedule; by default wavefront measures and the others must agree with it")
      ->type_name("MODE");
  sub->add_option("--threads", command->threads, "Cases at a time; 0, the default, takes all threads")
      ->type_name("N")
      ->check(CLI::Range(0, 65536));
  sub->add_option("--json", command->json, "Write all findings as JSON; - is stdout, without the text")->type_name("FILE");
  sub->add_option("--html", command->html, "Write all findings as a page")->type_name("FILE");
  sub->footer(kExamples);
  sub->callback([command, &exit_code] { exit_code = run_check(*command); });
}

}  // namespace phalanx
