// Layout: magic, version, length of the head, head, its CRC32C; then tile after tile: rectangle, samples,
// bytes of the film, CRC32C of all that. Numbers in the order of x86 bytes.
#include "checkpoint.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "../core/bytes.h"
#include "../core/crc32c.h"
#include "../core/error.h"
#include "../output/files.h"
#include "../report/version.h"
#include "../wavefront/isa.h"

namespace phalanx {
namespace {

constexpr char kMagic[8] = {'P', 'H', 'L', 'X', 'C', 'K', 'P', 'T'};
constexpr std::uint32_t kFormat = 1;

std::span<const std::byte> bytes_of(const std::string &text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::vector<std::byte> head_bytes(const PictureFacts &facts, std::size_t num_tiles,
                                  const Tally &tally) {
  ByteWriter head;
  head.put(static_cast<std::uint32_t>(facts.size()));
  for (const auto &[name, value] : facts) {
    head.put_text(name);
    head.put_text(value);
  }
  head.put(tally);
  head.put(static_cast<std::uint64_t>(num_tiles));
  return head.take();
}

std::string differences(const PictureFacts &found, const PictureFacts &wanted) {
  std::string text;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const bool is_known = i < found.size() && found[i].first == wanted[i].first;
    const std::string other = is_known ? found[i].second : "unknown";
    if (other == wanted[i].second) continue;
    text += fmt::format("{}{} {} instead of {}", text.empty() ? "" : ", ", wanted[i].first, other,
                        wanted[i].second);
  }
  return text;
}

[[noreturn]] void damaged(const std::string &name, const std::string &what) {
  throw InputError(fmt::format("{}: {}", name, what));
}

Rect checked_rect(Rect r, Rect crop, const std::string &name) {
  const bool inside = r.width > 0 && r.height > 0 && r.x >= crop.x && r.y >= crop.y &&
                      r.width <= crop.width && r.height <= crop.height &&
                      r.x - crop.x <= crop.width - r.width && r.y - crop.y <= crop.height - r.height;
  if (!inside) damaged(name, "a tile lies outside the picture");
  return r;
}

}  // namespace

PictureFacts picture_facts(const Plan &plan, const RenderOptions &options,
                           std::uint64_t scene_fingerprint) {
  const FrameView &f = plan.frame;
  const Rect c = plan.crop;
  Fingerprint frame;  // the rest: camera, filter, sampler, integrator
  const auto add = [&](const auto &value) { frame.add(std::as_bytes(std::span(&value, 1))); };
  add(f.camera), add(f.sampler), add(f.roulette_depth), add(f.integrator), add(f.occlusion_distance);
  frame.add(std::as_bytes(std::span(plan.filter_offsets)));
#ifdef PHALANX_FAST
  const char *const build = "fast";
#else
  const char *const build = "exact";
#endif
  return {
      {"program version", version()},
      {"build", build},
      {"scene", fmt::format("{:016x}", scene_fingerprint)},
      {"camera and sampling", fmt::format("{:016x}", frame.value())},
      {"size", fmt::format("{}x{}", f.width, f.height)},
      {"crop", fmt::format("{},{},{},{}", c.x, c.y, c.width, c.height)},
      {"seed", std::to_string(f.seed)},
      {"samples per pixel", std::to_string(plan.spp)},
      {"clamp", fmt::format("{}", plan.clamp)},
      {"max depth", std::to_string(f.max_depth)},
      {"first-hit layers", plan.aovs ? "yes" : "no"},
      {"instruction set", resolve_isa(options.isa)},
      {"schedule", options.mode == Mode::kRecursive ? "recursive" : "iterative"},
  };
}

std::string checkpoint_bytes(const PictureFacts &facts, const Film &film,
                             const std::vector<BookTile> &tiles, const Tally &tally) {
  const std::vector<std::byte> head = head_bytes(facts, tiles.size(), tally);
  std::string out;
  out.reserve(head.size() + static_cast<std::size_t>(
                                film.num_pixels() * Film::bytes_per_pixel(film.has_aovs())) +
              tiles.size() * 64 + 64);
  const auto put = [&](std::span<const std::byte> bytes) {
    out.append(reinterpret_cast<const char *>(bytes.data()), bytes.size());
  };
  const auto put_value = [&](const auto &value) { put(std::as_bytes(std::span(&value, 1))); };
  put_value(kMagic);
  put_value(kFormat);
  put_value(static_cast<std::uint64_t>(head.size()));
  put(head);
  put_value(crc32c(head));
  for (const BookTile &tile : tiles) {
    const std::size_t start = out.size();
    const std::vector<std::byte> pixels = film.region_bytes(tile.rect);
    put_value(tile.rect);
    put_value(tile.samples);
    put(pixels);
    put_value(crc32c(bytes_of(out).subspan(start)));
  }
  return out;
}

Checkpoint read_checkpoint(const std::string &bytes, const std::string &name,
                           const PictureFacts &facts, Rect crop, bool aovs) {
  ByteReader in(bytes_of(bytes));
  try {
    const auto magic = in.get_bytes(sizeof kMagic);
    if (std::memcmp(magic.data(), kMagic, sizeof kMagic) != 0) damaged(name, "this is not a checkpoint");
    if (in.get<std::uint32_t>() != kFormat)
      damaged(name, "this checkpoint has a format that this program does not read");
    const auto head = in.get_bytes(in.get<std::uint64_t>());
    if (in.get<std::uint32_t>() != crc32c(head)) damaged(name, "the head is damaged (CRC32C)");

    ByteReader h(head);
    PictureFacts found(std::min<std::size_t>(h.get<std::uint32_t>(), 1000));
    for (auto &[key, value] : found) {
      key = h.get_text();
      value = h.get_text();
    }
    const std::string difference = differences(found, facts);
    if (!difference.empty())
      damaged(name, "this is the checkpoint of another picture: " + difference);

    Checkpoint checkpoint{Film(crop, aovs), {}, h.get<Tally>(), ""};
    const auto num_tiles = h.get<std::uint64_t>();
    std::int64_t pixels = 0;
    for (std::uint64_t t = 0; t < num_tiles; ++t) {
      const std::span<const std::byte> from = in.rest();
      BookTile tile;
      tile.rect = checked_rect(in.get<Rect>(), crop, name);
      tile.samples = in.get<int>();
      const auto area = std::int64_t{tile.rect.width} * tile.rect.height;
      const auto film = in.get_bytes(static_cast<std::size_t>(area * Film::bytes_per_pixel(aovs)));
      const auto all = from.first(from.size() - in.rest().size());
      if (in.get<std::uint32_t>() != crc32c(all))
        damaged(name, fmt::format("tile {} is damaged (CRC32C)", t));
      if (tile.samples < 0) damaged(name, "a tile has a negative number of samples");
      checkpoint.film.set_region(tile.rect, film);
      checkpoint.tiles.push_back(tile);
      pixels += area;
    }
    if (pixels != checkpoint.film.num_pixels() || !in.rest().empty())
      damaged(name, "the tiles do not make up the picture");
    return checkpoint;
  } catch (const std::out_of_range &) {
    damaged(name, "the file ends too early");
  }
}

void write_checkpoint(const std::string &path, const std::string &bytes) {
  if (::access(path.c_str(), F_OK) == 0 && !is_device(path)) {
    // A second name for what is there, then the new file takes the first name: never a moment without.
    const std::string previous = path + ".previous", draft = path + ".link";
    ::unlink(draft.c_str());
    if (::link(path.c_str(), draft.c_str()) == 0) {
      if (::rename(draft.c_str(), previous.c_str()) != 0) {
        const int error = errno;
        ::unlink(draft.c_str());
        throw WriteError(fmt::format("{}: cannot replace: {}", previous, std::strerror(error)));
      }
    } else {  // a file system without links
      write_file(previous, read_file(path));
    }
  }
  write_file(path, bytes);
}

std::optional<Checkpoint> load_checkpoint(const std::string &path, const PictureFacts &facts,
                                          Rect crop, bool aovs) {
  const std::string previous = path + ".previous";
  const bool has_previous = ::access(previous.c_str(), F_OK) == 0;
  if (::access(path.c_str(), F_OK) != 0 && !has_previous) return std::nullopt;
  try {
    return read_checkpoint(read_file(path), path, facts, crop, aovs);
  } catch (const InputError &error) {
    if (!has_previous) throw;
    try {
      Checkpoint older = read_checkpoint(read_file(previous), previous, facts, crop, aovs);
      older.warning = fmt::format("{}; going on from {}", error.what(), previous);
      return older;
    } catch (const InputError &) {
    }
    throw;
  }
}

}  // namespace phalanx
