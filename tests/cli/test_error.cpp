// Limits and the error estimate, as a user meets them.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "program.h"

using namespace phalanx;
using Json = nlohmann::json;

namespace {

bool contains(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}


}  // namespace

TEST_CASE("cli: --target-error says what was achieved, and every check has a line") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome o = phalanx_in(dir, "render s.json -o a.png --target-error 5e-3 --report r.json");
  CHECK(o.exit_code == 0);
  CHECK(contains(o.err, "pass 64 | "));
  CHECK(contains(o.err, "pass 96 | "));
  CHECK(contains(o.err, " | ETA to 5e-3: "));
  CHECK(contains(o.err, " | slope -"));
  CHECK(contains(o.err, " | invalid 0\n"));
  CHECK(contains(o.err, "stopped by target | target 5e-3 met"));
  const Json report = Json::parse(read_file(dir / "r.json"));
  CHECK(report["stopped_by"] == "target");
  const Json &error = report["error"];
  CHECK(error["target"] == 5e-3);
  CHECK(error["target_met"] == "yes");
  CHECK(error["hi95"] <= 5e-3);
  CHECK(error["lo95"] < error["relmse_estimate"]);
  CHECK(error["replicates"] == 16);
  CHECK(error["checks"].size() >= 2);
  CHECK(error["checks"].back()["spp"] == report["spp"]);
  CHECK(error["image_mean"] > 0);
  CHECK(error["tiles"]["count"] == 4);
  CHECK(error["tiles"]["worst"].size() == 3);
}

TEST_CASE("cli: limits go together, and a target that was not met is said") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome o =
      phalanx_in(dir, "render s.json -o a.png --target-error 1e-9 --spp 128 --time 1000 --report r.json");
  CHECK(o.exit_code == 0);
  CHECK(contains(o.err, "target 1e-9 not met"));
  const Json report = Json::parse(read_file(dir / "r.json"));
  CHECK(report["stopped_by"] == "spp");
  CHECK(report["spp"] == 128);
  CHECK(report["error"]["target_met"] == "no");
  const Outcome timed = phalanx_in(dir, "render s.json -o a.png --size 64x64 --time 0.5 --target-error 1e-9 --report r.json");
  CHECK(timed.exit_code == 0);
  const Json by_time = Json::parse(read_file(dir / "r.json"));
  CHECK(by_time["stopped_by"] == "time");
  CHECK(by_time["wall_s"] < 2);
  CHECK(by_time["spp"] >= 64);  // the scene's 4 are no limit beside another
}

TEST_CASE("cli: without an error estimate there are no replicates") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  CHECK(phalanx_in(dir, "render s.json -o a.png --report r.json").exit_code == 0);
  const Json off = Json::parse(read_file(dir / "r.json"));
  CHECK(off["error"]["replicates"] == 0);
  CHECK(off["error"]["target"].is_null());
  CHECK(off["error"]["tiles"].is_null());
  CHECK(off["error"]["checks"].empty());
  CHECK(contains(phalanx_in(dir, "plan s.json").out, "replicates for the error"));
  const Json plan = Json::parse(phalanx_in(dir, "plan s.json --error on --json").out);
  CHECK(plan["replicates"] == 16);
  CHECK(plan["memory_bytes"]["replicates"] == 16 * 12 * (16 * 12 + 24));
}

TEST_CASE("cli: samples that do not divide into replicates are rounded, and that is said") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome o = phalanx_in(dir, "render s.json -o a.png --error on --spp 20");
  CHECK(contains(o.err, "32 samples per pixel instead of 20: a multiple of 16 replicates"));
  CHECK(contains(phalanx_in(dir, "render s.json -o a.png --adaptive --spp 18").err,
                 "20 samples per pixel instead of 18: a multiple of 4"));
}

TEST_CASE("cli: --sampler, and --adaptive with its pilot") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  CHECK(phalanx_in(dir, "render s.json -o a.png --sampler halton --adaptive --spp 64 --report r.json").exit_code == 0);
  const Json report = Json::parse(read_file(dir / "r.json"));
  CHECK(report["sampler"] == "halton");
  CHECK(report["adaptive"]["pilot_spp"] == 16);
  CHECK(report["samples_per_pixel"] > 0);
}
