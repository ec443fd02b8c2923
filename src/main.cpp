// The program: reads the command line, runs one command, turns what went wrong into an exit code.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "cli/commands.h"
#include "cli/text.h"
#include "core/error.h"
#include "distribute/ranks.h"
#include "report/version.h"
#include "scene/accel.h"
#include "wavefront/isa.h"

namespace phalanx {
namespace {

std::string version_text() {
  return fmt::format("phalanx {} ({}; instruction set {})", version(), Accel::library_version(),
                     best_isa());
}

/// Of several ranks with the same command line one is enough to say what is wrong with it, and to end
/// with that code.
bool speaks() { return launched_rank() == 0; }

int bad_command_line(const CLI::App &app, const CLI::ParseError &error) {
  if (!speaks()) return kExitDone;
  if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
  fmt::print(stderr, "phalanx: {}\nSee phalanx --help, or phalanx COMMAND --help.\n", error.what());
  return kExitBadInput;
}

/// CLI11 would only say that a command is missing.
void check_command(const CLI::App &app, const std::string &word) {
  std::vector<std::string> names;
  for (const CLI::App *command : app.get_subcommands({})) names.push_back(command->get_name());
  if (word.starts_with('-') || std::find(names.begin(), names.end(), word) != names.end()) return;
  throw InputError(
      fmt::format("unknown command \"{}\"; commands are {}", word, fmt::join(names, ", ")));
}

int run(int argc, char **argv) {
  int exit_code = kExitDone;
  CLI::App app("Phalanx, a wavefront path tracer", "phalanx");
  app.set_version_flag("--version", version_text, "Print the version");
  app.require_subcommand(1);
  app.footer("phalanx COMMAND --help shows the options of a command and examples.");
  add_render_command(app, exit_code);
  add_plan_command(app, exit_code);
  add_info_command(app, exit_code);
  add_diff_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_check_command(app, exit_code);
  add_replay_command(app, exit_code);
  add_converge_command(app, exit_code);
  if (argc > 1) check_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return bad_command_line(app, error);
  }
  return exit_code;
}

/// What was printed must have arrived: `phalanx plan S > /dev/full` is an error.
void flush_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw WriteError("cannot write to stdout");
}

int failure(const char *message, int exit_code) {
  fmt::print(stderr, "phalanx: {}\n", message);
  return exit_code;
}

}  // namespace
}  // namespace phalanx

int main(int argc, char **argv) {
  using namespace phalanx;
  constexpr int kInternalError = 1;
  std::signal(SIGPIPE, SIG_IGN);  // writing to a closed pipe is an error like any other
  try {
    const int exit_code = run(argc, argv);
    flush_stdout();
    return exit_code;
  } catch (const InputError &error) {
    if (!speaks()) return kExitDone;
    print_problems(error.problems());
    return kExitBadInput;
  } catch (const WriteError &error) {
    return failure(error.what(), kExitCannotWrite);
  } catch (const MemoryError &error) {
    return failure(error.what(), kExitOutOfMemory);
  } catch (const std::bad_alloc &) {
    return failure("out of memory", kExitOutOfMemory);
  } catch (const std::system_error &error) {  // fmt::print: stdout is full or closed
    return failure(error.what(), kExitCannotWrite);
  } catch (const std::exception &error) {
    return failure(error.what(), kInternalError);
  }
}
