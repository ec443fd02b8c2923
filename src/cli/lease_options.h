// Options of `render` about ranks and checkpoints, and what follows from them.
#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "../distribute/lease_render.h"
#include "outputs.h"

namespace phalanx {

struct LeaseCommand {
  std::optional<Balance> balance;
  bool shared_files = false;
  std::string checkpoint, map;
  double checkpoint_every_s = 60;
  bool resume = false;

  /// True if a rendering has to go by leases: it has other ranks, or needs what only leases offer.
  bool needs_leases(const Ranks &ranks) const {
    return ranks.size() > 1 || balance || !checkpoint.empty() || !map.empty();
  }
};

void add_lease_options(CLI::App &command, LeaseCommand &lease);

/// Throws InputError for a checkpoint or map that is the scene or an output, or a checkpoint that exists
/// though --resume was not given; WriteError for what cannot be written.
void check_lease_outputs(const LeaseCommand &lease, const std::string &scene,
                         const Outputs &outputs);

}  // namespace phalanx
