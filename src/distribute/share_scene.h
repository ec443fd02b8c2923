// The start of a run with several ranks: all get the same scene, or all stop.
#pragma once
#include <functional>

#include "../plan/options.h"
#include "../scene/loaded_scene.h"
#include "ranks.h"

namespace phalanx {

/// Another rank could not go on, and rank 0 says so: this one has nothing to add.
struct StoppedByOthers {};

/// Runs `step` on every rank. If it failed anywhere, it fails everywhere: rank 0 throws its own exception
/// or, with the rank's number in front, that of the first rank that has one; others throw StoppedByOthers.
void agree(Ranks &ranks, const std::function<void()> &step);

/// Rank 0 loads the scene and sends it to the others, built. With `shared_files` all ranks load it.
LoadedScene load_on_all(Ranks &ranks, bool shared_files,
                        const std::function<LoadedScene()> &load);

/// The widest instruction set that all ranks have, or options.isa if all have it.
std::string common_isa(Ranks &ranks, const std::string &wanted);

/// Rank 0's text arrives in all; they are the same, or it throws: InputError on rank 0.
void check_same(Ranks &ranks, const std::string &text, const std::string &what);

/// One number of each rank, on all ranks.
std::vector<int> share_numbers(Ranks &ranks, int own);

}  // namespace phalanx
