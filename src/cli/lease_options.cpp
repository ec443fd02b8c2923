#include "lease_options.h"

#include <cmath>
#include <filesystem>

#include "../core/error.h"
#include "../output/files.h"
#include "../output/image_file.h"

namespace phalanx {

void add_lease_options(CLI::App &command, LeaseCommand &lease) {
  command
      .add_option_function<std::string>(
          "--balance",
          [&lease](const std::string &name) {
            lease.balance = balance_from_name(name);
            if (!lease.balance)
              throw InputError("--balance: expected rows, columns, grid, bbox, cost or dynamic, "
                               "found \"" + name + "\"");
          },
          "How ranks share the picture: dynamic (default), cost, rows, columns, grid, bbox")
      ->type_name("NAME");
  command.add_flag("--shared-fs", lease.shared_files,
                   "All ranks read the scene's files; otherwise rank 0 sends them the scene");
  command
      .add_option("--balance-map", lease.map,
                  "Write an EXR with layers rank (that rendered a pixel last) and cost (seconds a sample)")
      ->type_name("FILE");
  CLI::Option *checkpoint =
      command
          .add_option("--checkpoint", lease.checkpoint,
                      "Keep the state of the rendering in this file; the one before stays as FILE.previous")
          ->type_name("FILE");
  command
      .add_option_function<std::string>(
          "--checkpoint-every",
          [&lease](const std::string &text) {
            if (!CLI::detail::lexical_cast(text, lease.checkpoint_every_s) ||
                !std::isfinite(lease.checkpoint_every_s) || lease.checkpoint_every_s <= 0)
              throw InputError("--checkpoint-every: expected a number of seconds above 0, found \"" +
                               text + "\"");
          },
          "Seconds between checkpoints; 60 by default")
      ->type_name("SECONDS")
      ->needs(checkpoint);
  command
      .add_flag("--resume", lease.resume,
                "Go on from the checkpoint; without one there, start from the beginning")
      ->needs(checkpoint);
}

void check_lease_outputs(const LeaseCommand &lease, const std::string &scene,
                         const Outputs &outputs) {
  for (const std::string &path : {lease.checkpoint, lease.map}) {
    if (path.empty()) continue;
    std::vector<std::string> others = outputs.images;
    others.push_back(scene);
    if (!outputs.report.empty()) others.push_back(outputs.report);
    others.push_back(path == lease.checkpoint ? lease.map : lease.checkpoint);
    for (const std::string &other : others)
      if (path == other || is_same_file(path, other))
        throw InputError(path + ": this is the scene or another output; choose another file");
    check_output_path(path);
  }
  if (!lease.map.empty() && image_format(lease.map) != ImageFormat::kExr)
    throw InputError("--balance-map " + lease.map + ": its layers need an EXR file");
  if (!lease.checkpoint.empty() && is_device(lease.checkpoint))
    throw InputError(lease.checkpoint + ": a checkpoint needs a file, not a device");
  if (!lease.checkpoint.empty() && !lease.resume && std::filesystem::exists(lease.checkpoint))
    throw InputError(lease.checkpoint +
                     ": there is a checkpoint already; go on from it with --resume, or remove it");
}

}  // namespace phalanx
