// phalanx converge as a user meets it.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "program.h"

using namespace phalanx;
using Json = nlohmann::json;

TEST_CASE("cli: converge measures contestants on the same seeds, with two halves of a reference") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  std::filesystem::create_directory(dir / "maps");
  const Outcome o = phalanx_in(dir,
                               "converge s.json --modes wavefront,depth-first --samplers sobol,independent --seeds "
                               "4 --max-spp 128 --error on --json c.json --csv c.csv --maps maps");
  CHECK(o.exit_code == 0);
  CHECK(o.out.find("reference: two halves of 512 samples per pixel") != std::string::npos);
  CHECK(o.out.find("against wavefront, sobol") != std::string::npos);
  const Json json = Json::parse(read_file(dir / "c.json"));
  const Json &curves = json["scenes"][0]["curves"];
  REQUIRE(curves.size() == 4);
  for (const Json &curve : curves) {
    CHECK(curve["runs"].size() == 4);
    CHECK(curve["points"].size() == 2);  // 64 and 128
    CHECK(curve["points"][1]["relmse"] < curve["points"][0]["relmse"]);
    CHECK(curve["points"][1]["wall_s"] > 0);
    const double ratio = double(curve["points"][1]["estimate"]) / double(curve["points"][1]["relmse"]);
    // 16 x 12 pixels with black beside white: the estimate is at its worst.
    CHECK(ratio > 0.3);
    CHECK(ratio < 3);
  }
  // The same bits have the same errors; each schedule has its own times.
  CHECK(curves[0]["points"][1]["relmse"] == curves[2]["points"][1]["relmse"]);
  CHECK(curves[0]["points"][1]["relmse"] != curves[1]["points"][1]["relmse"]);
  CHECK(curves[0]["points"][1]["wall_s"] != curves[2]["points"][1]["wall_s"]);
  CHECK(std::filesystem::exists(dir / "maps/s-wavefront-sobol.png"));
  CHECK(read_file(dir / "c.csv").find("depth-first,independent,128") != std::string::npos);
}

TEST_CASE("cli: converge with a reference from files, and with a limit of time") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  for (const char *name : {"a", "b"})
    CHECK(phalanx_in(dir, std::string("render s.json --quiet --spp 256 --seed ") + (name[0] == 'a' ? "1" : "2") +
                              " -o " + name + ".exr").exit_code == 0);
  const Outcome halves = phalanx_in(dir, "converge s.json --seeds 2 --max-spp 32 --reference a.exr,b.exr");
  CHECK(halves.exit_code == 0);
  CHECK(halves.out.find("the halves a.exr and b.exr") != std::string::npos);
  const Outcome one = phalanx_in(dir, "converge s.json --seeds 2 --max-time 0.05 --reference a.exr");
  CHECK(one.exit_code == 0);
  CHECK(one.out.find("errors hold its own") != std::string::npos);
}

TEST_CASE("cli: converge refuses what it cannot do") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  CHECK(phalanx_in(dir, "render s.json --quiet --size 8x8 -o small.exr").exit_code == 0);
  for (const char *arguments :
       {"", "s.json --modes fast", "s.json --samplers random", "s.json --seeds 1", "s.json --max-spp 8",
        "s.json --max-time 0", "s.json --targets 0", "s.json --targets x", "s.json --error maybe",
        "s.json --error on --max-spp 32", "s.json --reference missing.exr", "s.json --reference small.exr",
        "s.json --reference a,b,c", "s.json --maps missing", "s.json --json x --csv x", "s.json --json s.json"}) {
    CAPTURE(arguments);
    const Outcome o = phalanx_in(dir, std::string("converge ") + arguments);
    CHECK(o.exit_code == 2);
    CHECK(o.err.starts_with("phalanx: "));
  }
}
