// A rendering on disk: the film to the last bit, which samples it has, and what it is a rendering of.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "../core/stats.h"
#include "../film/film.h"
#include "../plan/plan.h"
#include "lease_book.h"

namespace phalanx {

/// Everything that the bits of a film depend on but its samples, as names and values for people.
using PictureFacts = std::vector<std::pair<std::string, std::string>>;
PictureFacts picture_facts(const Plan &plan, const RenderOptions &options,
                           std::uint64_t scene_fingerprint);

/// What adds up while rendering, beside the film.
struct Tally {
  RayCounts rays;
  InvalidSamples invalid;
  double seconds = 0;  // of rendering
};

struct Checkpoint {
  Film film;
  std::vector<BookTile> tiles;  // they cover the crop window; owners are not kept
  Tally tally;
  std::string warning;          // why the older of two generations was read; empty: the newer one
};

/// With a checksum for the head and one for each tile.
std::string checkpoint_bytes(const PictureFacts &facts, const Film &film,
                             const std::vector<BookTile> &tiles, const Tally &tally);

/// Throws InputError, starting with `name`: not a checkpoint, damaged, or of another picture, and then in
/// what it differs from `facts`.
Checkpoint read_checkpoint(const std::string &bytes, const std::string &name,
                           const PictureFacts &facts, Rect crop, bool aovs);

/// Replaces `path` at one instant; what stood there stays as path.previous. Throws WriteError.
void write_checkpoint(const std::string &path, const std::string &bytes);

/// From `path`, or from path.previous where that is damaged. Throws InputError. No checkpoint there: none.
std::optional<Checkpoint> load_checkpoint(const std::string &path, const PictureFacts &facts,
                                          Rect crop, bool aovs);

}  // namespace phalanx
