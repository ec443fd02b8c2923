// The commands of the program. Each has one file, and all do the same: parse, call the library,
// report.
#pragma once
#include <CLI/CLI.hpp>

namespace phalanx {

/// Each adds a subcommand to `app` that sets `exit_code` (core/error.h) when it has run. `exit_code`
/// must outlive the parsing of the command line.
void add_render_command(CLI::App &app, int &exit_code);
void add_plan_command(CLI::App &app, int &exit_code);
void add_info_command(CLI::App &app, int &exit_code);
void add_diff_command(CLI::App &app, int &exit_code);
void add_compare_command(CLI::App &app, int &exit_code);
void add_check_command(CLI::App &app, int &exit_code);
void add_replay_command(CLI::App &app, int &exit_code);
void add_converge_command(CLI::App &app, int &exit_code);

}  // namespace phalanx
