// A checkpoint gives back every bit, or says why not.
#include "distribute/checkpoint.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "../output/temp_dir.h"
#include "../support/scenes.h"
#include "core/bytes.h"
#include "core/crc32c.h"
#include "core/error.h"
#include "distribute/partition.h"
#include "output/files.h"

using namespace phalanx;

namespace {

const Rect kCrop = {3, 4, 21, 13};
const PictureFacts kFacts = {{"scene", "abc"}, {"seed", "7"}};

Film some_film(bool aovs) {
  Film film(kCrop, aovs);
  InvalidSamples invalid;
  for (int y = 0; y < kCrop.height; ++y)
    for (int x = 0; x < kCrop.width; ++x) {
      float samples[9], records[14] = {};
      for (int i = 0; i < 9; ++i) samples[i] = 0.1f * static_cast<float>(x + i) + static_cast<float>(y);
      records[0] = 0.3f;
      records[6] = static_cast<float>(x);
      film.add_samples(kCrop.x + x, kCrop.y + y, samples, 1 + (x + y) % 3, 0, invalid);
      if (aovs) film.add_aovs(kCrop.x + x, kCrop.y + y, records, 2);
    }
  return film;
}

std::vector<BookTile> some_tiles() {
  std::vector<BookTile> tiles;
  for (const Rect &r : tiles_of(kCrop, 8)) tiles.push_back({r, -1, 16 + static_cast<int>(tiles.size())});
  return tiles;
}

std::string some_checkpoint(bool aovs) {
  Tally tally;
  tally.rays = {1, 2, 3};
  tally.invalid.add(5, 6, 9);
  return checkpoint_bytes(kFacts, some_film(aovs), some_tiles(), tally);
}

std::string reason(const std::string &bytes, const PictureFacts &facts, Rect crop = kCrop,
                   bool aovs = true) {
  try {
    read_checkpoint(bytes, "f.ckpt", facts, crop, aovs);
    return "";
  } catch (const InputError &error) {
    return error.what();
  }
}

bool contains(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("crc32c: the vectors of RFC 3720, in one go and in pieces") {
  std::vector<std::byte> zeros(32, std::byte{0}), ones(32, std::byte{0xff}), rising(32);
  for (std::size_t i = 0; i < 32; ++i) rising[i] = static_cast<std::byte>(i);
  CHECK(crc32c(zeros) == 0x8a9136aau);
  CHECK(crc32c(ones) == 0x62a8ab43u);
  CHECK(crc32c(rising) == 0x46dd794eu);
  const std::span<const std::byte> all(rising);
  CHECK(crc32c(all.subspan(13), crc32c(all.first(13))) == 0x46dd794eu);
}

TEST_CASE("fingerprint: changes with every bit, and with the length") {
  std::vector<std::byte> bytes(100, std::byte{0});
  const auto print = [&] {
    Fingerprint f;
    f.add(bytes);
    return f.value();
  };
  const std::uint64_t zero = print();
  CHECK(print() == zero);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = std::byte{1};
    CHECK(print() != zero);
    bytes[i] = std::byte{0};
  }
  bytes.push_back(std::byte{0});
  CHECK(print() != zero);
}

TEST_CASE("checkpoint: every bit comes back") {
  for (const bool aovs : {false, true}) {
    const Film film = some_film(aovs);
    const Checkpoint back = read_checkpoint(some_checkpoint(aovs), "f", kFacts, kCrop, aovs);
    CHECK(back.film.region_bytes(kCrop) == film.region_bytes(kCrop));
    CHECK(test::pixels_that_differ(back.film, film) == 0);
    REQUIRE(back.tiles.size() == some_tiles().size());
    CHECK(back.tiles[3].samples == 19);
    CHECK(back.tiles[3].rect.x == some_tiles()[3].rect.x);
    CHECK(back.tally.rays.shadow == 3);
    CHECK(back.tally.invalid.sample == 9);
  }
}

TEST_CASE("checkpoint: cut off anywhere it is refused") {
  const std::string whole = some_checkpoint(true);
  for (std::size_t size = 0; size < whole.size(); size += size < 600 ? 1 : 97) {
    CAPTURE(size);
    CHECK(reason(whole.substr(0, size), kFacts) != "");
  }
  CHECK(reason(whole + "x", kFacts) != "");
  CHECK(reason(whole, kFacts) == "");
}

TEST_CASE("checkpoint: any changed byte is found") {
  const std::string whole = some_checkpoint(true);
  for (std::size_t at = 0; at < whole.size(); at += at < 600 ? 1 : 53) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    CAPTURE(at);
    CHECK(reason(damaged, kFacts) != "");
  }
}

TEST_CASE("checkpoint: of another picture it is refused, and in what it differs is said") {
  const std::string whole = some_checkpoint(true);
  CHECK(contains(reason(whole, {{"scene", "abc"}, {"seed", "8"}}), "seed 7 instead of 8"));
  CHECK(contains(reason(whole, {{"scene", "xyz"}, {"seed", "7"}}), "scene abc instead of xyz"));
  CHECK(contains(reason(whole, {{"scene", "abc"}, {"seed", "7"}, {"build", "fast"}}), "build"));
  CHECK(contains(reason("nonsense of some length", kFacts), "not a checkpoint"));
  CHECK(reason(whole, kFacts, {3, 4, 20, 13}) != "");
  CHECK(reason(whole, kFacts, kCrop, false) != "");
}

TEST_CASE("checkpoint: the one before is kept, and read where the newer one is damaged") {
  const TempDir dir;
  const std::string path = dir / "a.ckpt", good = some_checkpoint(true);
  CHECK_FALSE(load_checkpoint(path, kFacts, kCrop, true));
  write_checkpoint(path, "first");
  CHECK(dir.list() == std::vector<std::string>{"a.ckpt"});
  write_checkpoint(path, good);
  CHECK(read_file(path + ".previous") == "first");
  CHECK(load_checkpoint(path, kFacts, kCrop, true)->warning == "");
  write_checkpoint(path, good.substr(0, 1000));
  const auto loaded = load_checkpoint(path, kFacts, kCrop, true);
  REQUIRE(loaded);
  CHECK(contains(loaded->warning, "going on from"));
  CHECK(dir.list() == std::vector<std::string>{"a.ckpt", "a.ckpt.previous"});
  put(path + ".previous", "damaged, too");
  CHECK_THROWS_AS(load_checkpoint(path, kFacts, kCrop, true), InputError);
}

TEST_CASE("checkpoint: the facts tell apart what gives other bits, and nothing else") {
  const auto facts = [](auto change) {
    const test::BuiltScene built = test::build_file("scenes/cornell-box.json", "");
    RenderOptions options;
    options.threads = 1;
    change(options);
    return picture_facts(make_plan(built.description, built.scene, options), options, 1);
  };
  const PictureFacts base = facts([](RenderOptions &) {});
  CHECK(facts([](RenderOptions &o) { o.threads = 3; }) == base);
  CHECK(facts([](RenderOptions &o) { o.tile_size = 8; }) == base);
  CHECK(facts([](RenderOptions &o) { o.wave_size = 64; }) == base);
  CHECK(facts([](RenderOptions &o) { o.mode = Mode::kDepthFirst; }) == base);
  CHECK(facts([](RenderOptions &o) { o.mode = Mode::kRecursive; }) != base);
  CHECK(facts([](RenderOptions &o) { o.seed = 5; }) != base);
  CHECK(facts([](RenderOptions &o) { o.width = o.height = 64; }) != base);
  CHECK(facts([](RenderOptions &o) { o.max_depth = 2; }) != base);
  CHECK(facts([](RenderOptions &o) { o.crop = {1, 1, 8, 8}; }) != base);
  CHECK(facts([](RenderOptions &o) { o.aovs = true; }) != base);
}
