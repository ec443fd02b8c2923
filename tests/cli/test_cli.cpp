// The command line is a contract: exit codes, files, and nothing written when something is wrong.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "output/image_file.h"
#include "program.h"

using namespace phalanx;
using Json = nlohmann::json;

namespace {

const std::vector<std::string> kOnlyScene = {"s.json"};

bool contains(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("cli: a bad command line is 2, says why, and writes nothing") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  for (const char *arguments : {"",
                                "frobnicate",
                                "render",
                                "render s.json --no-such-option",
                                "render missing.json",
                                "render s.json --size 0x10",
                                "render s.json --size 10",
                                "render s.json --size 10x10x10",
                                "render s.json --size 99999999999x1",
                                "render s.json --size -1x5",
                                "render s.json --spp 0",
                                "render s.json --spp 1.5",
                                "render s.json --spp many",
                                "render s.json --time 0",
                                "render s.json --time nan",
                                "render s.json --target-error 0",
                                "render s.json --target-error -1e-3",
                                "render s.json --target-error small",
                                "render s.json --target-error 1e-3 --error off",
                                "render s.json --error maybe",
                                "render s.json --error off --replicates 4",
                                "render s.json --replicates 12",
                                "render s.json --replicates 128",
                                "render s.json --sampler random",
                                "render s.json --mode fast",
                                "render s.json --crop 0,0,0,1",
                                "render s.json --crop 10,10,10,10",
                                "render s.json --crop 1,2",
                                "render s.json --max-depth -1",
                                "render s.json --threads -1",
                                "render s.json --isa z80",
                                "render s.json --tile-size 12",
                                "render s.json -o a.jpg",
                                "render s.json -o a.png --aov all",
                                "render s.json -o a.exr --aov colour",
                                "render s.json -o a.png -o a.png",
                                "render s.json --report s.json",
                                "render s.json s.json",
                                "plan missing.json",
                                "info missing.exr",
                                "diff missing.exr missing.exr",
                                "diff s.json s.json"}) {
    CAPTURE(arguments);
    const Outcome outcome = phalanx_in(dir, arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.starts_with("phalanx: "));
    CHECK(outcome.out == "");
    CHECK(dir.list() == kOnlyScene);
  }
  CHECK(read_file(dir / "s.json") == kSmallScene);
}

TEST_CASE("cli: a scene with mistakes shows all of them, one a line") {
  const TempDir dir;
  put(dir / "s.json", R"({"version": 1, "camera": {"fov": 200}, "film": {"widht": 3}})");
  const Outcome outcome = phalanx_in(dir, "render s.json -o a.png");
  CHECK(outcome.exit_code == 2);
  CHECK(contains(outcome.err, "fov"));
  CHECK(contains(outcome.err, "widht"));
  CHECK(dir.list() == kOnlyScene);
}

TEST_CASE("cli: help and version are 0 and go to stdout") {
  const TempDir dir;
  for (const char *arguments :
       {"--help", "--version", "render --help", "plan --help", "info --help", "diff --help"}) {
    CAPTURE(arguments);
    const Outcome outcome = phalanx_in(dir, arguments);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err == "");
    CHECK(contains(outcome.out, "halanx"));
  }
}

TEST_CASE("cli: what cannot be written is 5") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  std::filesystem::create_directory(dir / "d.png");
  for (const char *arguments :
       {"render s.json -o /dev/full", "render s.json -o missing/a.png", "render s.json -o d.png",
        "render s.json -o /dev/null --report /dev/full"}) {
    CAPTURE(arguments);
    const Outcome outcome = phalanx_in(dir, arguments);
    CHECK(outcome.exit_code == 5);
    CHECK(contains(outcome.err, "phalanx: "));
  }
  CHECK(dir.list() == std::vector<std::string>{"d.png", "s.json"});
}

TEST_CASE("cli: text that does not arrive is 5") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const std::string program = "'" PHALANX_PROGRAM "' info " + (dir / "s.json");
  CHECK(WEXITSTATUS(std::system((program + " > /dev/full 2> /dev/null").c_str())) == 5);
}

TEST_CASE("cli: without -o there are an EXR and a PNG named after the scene") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome outcome = phalanx_in(dir, "render s.json");
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.err, "wrote s.exr, s.png"));
  CHECK(dir.list() == std::vector<std::string>{"s.exr", "s.json", "s.png"});
  CHECK(read_image(dir / "s.exr").width == 16);
  CHECK(read_image(dir / "s.png").height == 12);
}

TEST_CASE("cli: images say how they were made") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  CHECK(phalanx_in(dir, "render s.json -o a.exr -o a.hdr -o a.png --seed 7").exit_code == 0);
  for (const char *name : {"a.exr", "a.hdr", "a.png"}) {
    CAPTURE(name);
    const Image image = read_image(dir / name);
    CHECK(find_metadata(image, "phalanx.seed") == "7");
    CHECK(find_metadata(image, "phalanx.spp") == "4");
    CHECK(find_metadata(image, "phalanx.scene") == "s.json");
  }
}

TEST_CASE("cli: --quiet prints nothing") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome outcome = phalanx_in(dir, "render s.json --quiet -o a.png");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out + outcome.err == "");
}

TEST_CASE("cli: the picture's options arrive in the report") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome outcome = phalanx_in(
      dir,
      "render s.json -o a.exr --size 32x24 --crop 4,6,8,10 --spp 16 --seed 3 --max-depth 5 "
      "--threads 1 --mode depth-first --report -");
  REQUIRE(outcome.exit_code == 0);
  const Json report = Json::parse(outcome.out);
  CHECK(report["width"] == 32);
  CHECK(report["height"] == 24);
  CHECK(report["crop"] == Json({4, 6, 8, 10}));
  CHECK(report["spp"] == 16);
  CHECK(report["seed"] == 3);
  CHECK(report["max_depth"] == 5);
  CHECK(report["threads"] == 1);
  CHECK(report["mode"] == "depth-first");
  CHECK(report["stopped_by"] == "spp");
  CHECK(report["rays"]["camera"] == 8 * 10 * 16);
  CHECK(report["invalid"]["count"] == 0);
  CHECK(report["peak_rss_bytes"] > 1'000'000);
  const Image image = read_image(dir / "a.exr");
  CHECK(image.width == 8);
  CHECK(image.x == 4);
  CHECK(image.full_height == 24);
}

TEST_CASE("cli: layers go into the EXR") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  CHECK(phalanx_in(dir, "render s.json -o a.exr -o a.png --aov all").exit_code == 0);
  const Image image = read_image(dir / "a.exr");
  CHECK(image.channels.size() == 14);
  CHECK(find_channel(image, "samples")->values[0] == 4);
  const std::vector<float> &albedo = find_channel(image, "albedo.R")->values;
  CHECK(*std::max_element(albedo.begin(), albedo.end()) == doctest::Approx(0.7));
}

TEST_CASE("cli: a picture does not depend on threads, tiles or waves") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  CHECK(phalanx_in(dir, "render s.json -o a.exr --spp 16").exit_code == 0);
  CHECK(phalanx_in(dir, "render s.json -o b.exr --spp 16 --threads 1 --tile-size 4 --wave-size 64")
            .exit_code == 0);
  const Json diff = Json::parse(phalanx_in(dir, "diff a.exr b.exr --json").out);
  CHECK(diff["num_different"] == 0);
  CHECK(diff["relmse"] == 0);
}

TEST_CASE("cli: --time renders at least one pass and then stops") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome outcome = phalanx_in(dir, "render s.json -o a.png --time 0.2 --report -");
  CHECK(outcome.exit_code == 0);
  const Json report = Json::parse(outcome.out);
  CHECK(report["spp"] >= 1);
  CHECK(report["wall_s"] < 2);
}

TEST_CASE("cli: a signal stops the rendering and the image is written") {
  // timeout(1) sends its signal twice, to the process and to its group.
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const std::string endless = "render s.json -o a.png --report r.json --size 256x256 --spp 1048576";
  for (const auto &[signal, exit_code] : {std::pair("INT", 130), {"TERM", 143}}) {
    CAPTURE(signal);
    const std::string stop_it = std::string("timeout --preserve-status -k 60 -s ") + signal + " 2";
    CHECK(phalanx_in(dir, endless, stop_it).exit_code == exit_code);
    REQUIRE(dir.list() == std::vector<std::string>{"a.png", "r.json", "s.json"});
    CHECK(read_image(dir / "a.png").width == 256);
    const Json report = Json::parse(read_file(dir / "r.json"));
    CHECK(report["stopped_by"] == "signal");
    CHECK(report["spp"] >= 1);
    std::filesystem::remove(dir / "a.png");
    std::filesystem::remove(dir / "r.json");
  }
}

TEST_CASE("cli: a second signal ends the program at once") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const std::string script =
      "cd " + dir.path() +
      " && { '" PHALANX_PROGRAM
      "' render s.json -o a.png --quiet --size 2048x2048 --spp 1048576 & } ; "
      "sleep 2; kill -TERM $!; sleep 0.3; kill -TERM $!; wait $!";
  CHECK(WEXITSTATUS(std::system(script.c_str())) == 143);
  CHECK(dir.list() == kOnlyScene);
}

TEST_CASE("cli: plan prints text, or JSON") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  CHECK(contains(phalanx_in(dir, "plan s.json").out, "shadow"));
  const Json plan = Json::parse(phalanx_in(dir, "plan s.json --size 64x64 --json").out);
  CHECK(plan["width"] == 64);
  CHECK(plan["kernels"].size() > 3);
  CHECK(plan["memory_bytes"]["total"] > 0);
  CHECK(dir.list() == kOnlyScene);
}

TEST_CASE("cli: info describes scenes and images") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome scene = phalanx_in(dir, "info s.json");
  CHECK(scene.exit_code == 0);
  CHECK(contains(scene.out, "quads                   2\n"));
  CHECK(contains(scene.out, "lights                  1\n"));
  CHECK(phalanx_in(dir, "render s.json -o a.exr --crop 1,2,3,4").exit_code == 0);
  const Outcome image = phalanx_in(dir, "info a.exr");
  CHECK(image.exit_code == 0);
  CHECK(contains(image.out, "3 x 4 pixels at (1, 2) of 16 x 12"));
  CHECK(contains(image.out, "NaN 0"));
  CHECK(contains(image.out, "phalanx.mode"));
}

TEST_CASE("cli: diff of two seeds finds noise and no bias") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const std::string common = "render s.json --quiet --size 80x80 --spp 64 --aov samples,variance ";
  CHECK(phalanx_in(dir, common + "-o a.exr --seed 1").exit_code == 0);
  CHECK(phalanx_in(dir, common + "-o b.exr --seed 2").exit_code == 0);
  const Outcome outcome = phalanx_in(dir, "diff a.exr b.exr --json -o d.exr -o d.png");
  REQUIRE(outcome.exit_code == 0);
  const Json diff = Json::parse(outcome.out);
  CHECK(diff["relmse"] > 0);
  CHECK(diff["welch"]["num_tiles"] == 100);
  CHECK(diff["flip"]["mean"] < 0.5);
  CHECK(find_channel(read_image(dir / "d.exr"), "error.flip") != nullptr);
  CHECK(phalanx_in(dir, "diff a.exr b.exr -o b.exr").exit_code == 2);
}
