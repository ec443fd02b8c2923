// Checkpoints of a single process: kill -9 at any time, go on, and every bit is as if nothing had happened.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "program_runs.h"

using namespace phalanx;
using Json = nlohmann::json;

namespace {

const std::string kGlass = std::string(PHALANX_SOURCE_DIR) + "/scenes/cornell-glass.json";

bool contains(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("resume: killed at random times, with other threads each time, the bits stay the same") {
  const TempDir dir;
  const std::string common = "render " + kGlass + " --quiet --size 120x100 --aov all --spp 384 ";
  REQUIRE(phalanx_in(dir, common + "-o one.exr --threads 2").exit_code == 0);
  const std::string kept = "-o a.exr --report r.json --checkpoint c.ckpt --checkpoint-every 0.05 --resume ";
  std::mt19937 random(1);
  int killed = 0;
  for (int i = 0; i < 8; ++i) {
    Background job(dir, common + kept + "--threads " + std::to_string(1 + i % 3));
    Background::pause(0.05 + 0.01 * static_cast<double>(random() % 25));
    job.signal(SIGKILL);
    killed += job.wait() == 128 + SIGKILL;
  }
  CHECK(killed > 2);
  REQUIRE(std::filesystem::exists(dir / "c.ckpt"));
  CHECK(phalanx_in(dir, common + kept + "--threads 1 --tile-size 8 --mode depth-first").exit_code == 0);
  CHECK(same_pictures(dir / "one.exr", dir / "a.exr"));
  const Json report = Json::parse(read_file(dir / "r.json"));
  CHECK(report["spp"] == 384);
  CHECK(report["rays"]["camera"] == 120 * 100 * 384);
  // Once more: it is finished, and the picture comes at once.
  CHECK(phalanx_in(dir, common + kept + "--threads 1").exit_code == 0);
  CHECK(same_pictures(dir / "one.exr", dir / "a.exr"));
  CHECK(Json::parse(read_file(dir / "r.json"))["resumed_spp"] == 384);
}

TEST_CASE("resume: a checkpoint of another picture is refused, and why is said") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const std::string common = "render s.json --quiet -o a.exr --checkpoint c.ckpt ";
  REQUIRE(phalanx_in(dir, common).exit_code == 0);
  const std::string checkpoint = read_file(dir / "c.ckpt");
  std::string other = kSmallScene;
  other.replace(other.find("0.7"), 3, "0.6");
  put(dir / "other.json", other);
  for (const auto &[arguments, text] :
       {std::pair(common, "--resume"),
        {common + "--resume --seed 3", "seed 0 instead of 3"},
        {common + "--resume --spp 8", "samples per pixel 4 instead of 8"},
        {common + "--resume --size 8x8", "size 16x12 instead of 8x8"},
        {common + "--resume --mode recursive", "schedule iterative instead of recursive"},
        {common + "--resume --max-depth 1", "max depth"},
        {common + "--resume --aov all", "first-hit layers no instead of yes"},
        {std::string("render other.json --quiet -o a.exr --checkpoint c.ckpt --resume"), "scene "}}) {
    CAPTURE(arguments);
    const Outcome outcome = phalanx_in(dir, arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(contains(outcome.err, text));
    CHECK(read_file(dir / "c.ckpt") == checkpoint);
  }
  put(dir / "c.ckpt", checkpoint.substr(0, checkpoint.size() / 2));
  const Outcome outcome = phalanx_in(dir, common + "--resume");
  CHECK(outcome.exit_code == 2);
  CHECK(contains(outcome.err, "ends too early"));
}

TEST_CASE("resume: options that do not fit are 2") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  for (const char *arguments :
       {"render s.json --resume", "render s.json --checkpoint-every 5",
        "render s.json --checkpoint c --checkpoint-every 0", "render s.json --checkpoint s.json",
        "render s.json --checkpoint c --checkpoint-every soon",
        "render s.json -o a.exr --checkpoint a.exr", "render s.json --balance-map m.png",
        "render s.json --checkpoint /dev/full --resume", "render s.json --checkpoint /dev/null",
        "render s.json --balance nobody"}) {
    CAPTURE(arguments);
    const Outcome outcome = phalanx_in(dir, arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.starts_with("phalanx: "));
    CHECK(dir.list() == std::vector<std::string>{"s.json"});
  }
  CHECK(phalanx_in(dir, "render s.json --checkpoint missing/c").exit_code == 5);
}

TEST_CASE("resume: a signal leaves image and checkpoint long before the end of a pass") {
  // A pass takes some four seconds on two cores. Stopping is to take less than one; a machine that
  // does other things, too, is given more.
  const TempDir dir;
  const std::string common = "render " + kGlass + " --quiet --size 800x600 --threads 2 ";
  for (const auto &[number, code] : {std::pair(SIGTERM, 143), {SIGINT, 130}}) {
    for (const char *kept : {"-o a.exr --spp 100000 --checkpoint c.ckpt", "-o a.exr --spp 100000"}) {
      CAPTURE(kept);
      Background job(dir, common + kept);
      Background::pause(0.8);
      const auto start = std::chrono::steady_clock::now();
      job.signal(number);
      CHECK(job.wait(10) == code);
      CHECK(seconds_since(start) < 3.0);
      CHECK(read_image(dir / "a.exr").width == 800);
      CHECK(std::filesystem::exists(dir / "c.ckpt") == contains(kept, "checkpoint"));
      std::filesystem::remove(dir / "a.exr");
      std::filesystem::remove(dir / "c.ckpt");
    }
  }
}

TEST_CASE("resume: SIGUSR1 writes the picture so far, and rendering goes on") {
  const TempDir dir;
  for (const char *option : {"", " --balance dynamic"}) {
    CAPTURE(option);
    Background job(dir, "render " + kGlass + " --quiet --size 64x48 --threads 1 --spp 100000 -o a.exr" + option);
    Background::pause(0.8);
    CHECK_FALSE(std::filesystem::exists(dir / "a.exr"));
    job.signal(SIGUSR1);
    REQUIRE(appears(dir / "a.exr", 10));
    Background::pause(0.1);
    CHECK(::kill(job.pid(), 0) == 0);
    job.signal(SIGTERM);
    CHECK(job.wait(10) == 143);
    std::filesystem::remove(dir / "a.exr");
  }
}
