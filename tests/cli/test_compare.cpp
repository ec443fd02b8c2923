// phalanx compare: its options, its exit codes, and the figures that do not depend on the machine.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "program.h"

using namespace phalanx;
using Json = nlohmann::json;

TEST_CASE("compare: four schedules on the same samples give the same bits") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome outcome = phalanx_in(dir, "compare s.json --runs 2 --spp 4 --json c.json");
  REQUIRE(outcome.exit_code == 0);
  for (const char *word : {"wavefront", "megakernel", "depth-first", "recursive", "ns/item"}) {
    CAPTURE(word);
    CHECK(outcome.out.find(word) != std::string::npos);
  }
  const Json json = Json::parse(read_file(dir / "c.json"));
  for (const char *key : {"version", "processor", "compiler", "embree", "geometric_mean_speed_up"})
    CHECK(json.contains(key));
  REQUIRE(json["scenes"].size() == 1);
  const Json &scene = json["scenes"][0];
  CHECK(scene["scene"] == "s.json");
  CHECK(scene["spp"] == 4);
  CHECK(scene["equal_bits"] == true);
  CHECK(scene["scaling"] == Json::array());
  REQUIRE(scene["schedules"].size() == 4);
  for (const Json &schedule : scene["schedules"]) {
    CAPTURE(schedule["mode"].get<std::string>());
    CHECK(schedule["rays"] == scene["schedules"][0]["rays"]);
    CHECK(schedule["rays"]["camera"] == 16 * 12 * 4);
    CHECK(schedule["seconds"]["runs"].size() == 2);
    CHECK(schedule["seconds"]["min"] > 0);
    CHECK(schedule["speed_up"]["median"] > 0);
    CHECK(schedule["mrays_per_s"] > 0);
    CHECK(schedule["stages"].size() > 1);
    if (schedule["mode"] != "recursive") CHECK(schedule["num_different"] == 0);
    CHECK(schedule["largest_relative_difference"] < 1e-5);
  }
  CHECK(scene["schedules"][0]["utilisation"] > 0);
  CHECK(scene["schedules"][0]["utilisation"] <= 1);
  CHECK(scene["schedules"][3]["speed_up"]["median"] == 1);
}

TEST_CASE("compare: thread counts are timed with the wavefront") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  const Outcome outcome =
      phalanx_in(dir, "compare s.json --modes wavefront --threads 1,2 --runs 1 --spp 1 --json -");
  REQUIRE(outcome.exit_code == 0);
  const Json scene = Json::parse(outcome.out)["scenes"][0];
  REQUIRE(scene["scaling"].size() == 2);
  CHECK(scene["scaling"][1]["threads"] == 2);
  CHECK(scene["scaling"][1]["num_different"] == 0);
  CHECK(scene["scaling"][0]["speed_up"]["median"] == 1);
  CHECK(scene["schedules"][0]["speed_up"].is_null());  // nothing recursive to compare with
  CHECK(scene["schedules"][0]["num_different"] == 0);  // depth-first is rendered all the same
}

TEST_CASE("compare: several scenes end in a geometric mean") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  put(dir / "t.json", kSmallScene);
  const Outcome outcome = phalanx_in(
      dir, "compare s.json t.json --modes wavefront,recursive --threads 1 --runs 1 --spp 1");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("geometric mean of 2 scenes") != std::string::npos);
}

TEST_CASE("compare: a bad command line is 2 and writes nothing") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  for (const char *arguments :
       {"", "missing.json", "s.json --modes fast", "s.json --modes wavefront,", "s.json --runs 0",
        "s.json --spp 0", "s.json --spp many", "s.json --size 0x4", "s.json --size 4",
        "s.json --threads 1,", "s.json --threads -1", "s.json --threads 1,2 --modes recursive",
        "s.json --isa z80", "s.json --tile-size 12", "s.json --wave-size 1",
        "s.json --json s.json"}) {
    CAPTURE(arguments);
    const Outcome outcome = phalanx_in(dir, std::string("compare ") + arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.starts_with("phalanx: "));
    CHECK(outcome.out == "");
    CHECK(dir.list() == std::vector<std::string>{"s.json"});
  }
  CHECK(phalanx_in(dir, "compare s.json --json no-such-folder/c.json").exit_code == 5);
}
