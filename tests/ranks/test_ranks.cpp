// mpirun for real: any number of ranks gives the bits of one, also when ranks are killed.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "program_runs.h"

using namespace phalanx;
using Json = nlohmann::json;

namespace {

const std::string kScenes = std::string(PHALANX_SOURCE_DIR) + "/scenes/";
const std::string kGlass = kScenes + "cornell-glass.json";

bool contains(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}

Json report_in(const TempDir &dir, const std::string &name) {
  return Json::parse(read_file(dir / name));
}

}  // namespace

TEST_CASE("ranks: any number of ranks, threads and any strategy give the bits of one, for odd sizes") {
  if (!can_run_ranks()) return;
  const TempDir dir;
  const int all_ranks[] = {2, 3, 5, 1, 2, 7, 3};
  int run = 0;
  for (const char *size : {"1x1", "1x37", "3x5", "31x17", "67x41"}) {
    const std::string common = "render " + kGlass + " --quiet --aov all --spp 20 --size " + size;
    REQUIRE(phalanx_in(dir, common + " -o one.exr --threads 1").exit_code == 0);
    for (const char *balance : {"dynamic", "rows", "columns", "grid", "bbox", "cost"}) {
      const int ranks = std::string(size) == "3x5" ? 7 : all_ranks[run % 7];
      const int threads = 1 + run++ / 2 % 2;
      CAPTURE(size);
      CAPTURE(balance);
      CAPTURE(ranks);
      CAPTURE(threads);
      const Outcome outcome = phalanx_in(
          dir, common + " -o several.exr --report r.json --balance " + balance + " --threads " +
                   std::to_string(threads),
          mpirun(ranks));
      CHECK(outcome.exit_code == 0);
      CHECK(outcome.err == "");
      CHECK(same_pictures(dir / "one.exr", dir / "several.exr"));
      const Json report = report_in(dir, "r.json");
      CHECK(report["ranks"] == ranks);
      CHECK(report["balance"] == balance);
      CHECK(report["per_rank"].size() == ranks);
      CHECK(report["warnings"].empty());
    }
  }
}

TEST_CASE("ranks: scenes arrive whole, read by rank 0 or by all") {
  if (!can_run_ranks()) return;
  const TempDir dir;
  for (const char *scene : {"fur.json", "materials-zoo.json", "many-lights.json", "menger.json"}) {
    CAPTURE(scene);
    const std::string common = "render " + kScenes + scene + " --quiet --spp 2 --size 61x43 --threads 1";
    REQUIRE(phalanx_in(dir, common + " -o one.exr").exit_code == 0);
    CHECK(phalanx_in(dir, common + " -o two.exr", mpirun(2)).exit_code == 0);
    CHECK(same_pictures(dir / "one.exr", dir / "two.exr"));
  }
  const std::string everything = std::string(PHALANX_SOURCE_DIR) + "/tests/scene/valid/everything.json";
  const std::string common = "render " + everything + " --quiet --spp 2 --size 33x29 --threads 1";
  REQUIRE(phalanx_in(dir, common + " -o one.exr").exit_code == 0);
  for (const char *option : {"", " --shared-fs"}) {
    CHECK(phalanx_in(dir, common + " -o two.exr" + option, mpirun(2)).exit_code == 0);
    CHECK(same_pictures(dir / "one.exr", dir / "two.exr"));
  }
}

TEST_CASE("ranks: what is wrong is said once, with its exit code") {
  if (!can_run_ranks()) return;
  const TempDir dir;
  put(dir / "bad.json", R"({"version": 1, "camera": {"fov": 200}})");
  put(dir / "s.json", kSmallScene);
  for (const auto &[arguments, code, text] :
       {std::tuple("render bad.json -o a.png", 2, "fov"),
        {"render missing.json -o a.png", 2, "no such file"},
        {"render s.json -o a.png --balance fair", 2, "--balance"},
        {"render s.json -o missing/a.png", 5, "missing/a.png"}}) {
    CAPTURE(arguments);
    const Outcome outcome = phalanx_in(dir, arguments, mpirun(3));
    CHECK(outcome.exit_code == code);
    const std::size_t first = outcome.err.find("phalanx: ");
    REQUIRE(first != std::string::npos);
    CHECK(contains(outcome.err, text));
    CHECK(outcome.err.find("phalanx: ", first + 1) == std::string::npos);
  }
  CHECK(dir.list() == std::vector<std::string>{"bad.json", "s.json"});
}

TEST_CASE("ranks: with a limit of time all pixels get the same samples") {
  if (!can_run_ranks()) return;
  const TempDir dir;
  for (const char *balance : {"dynamic", "cost"}) {
    const Outcome outcome = phalanx_in(
        dir, "render " + kGlass + " --quiet --size 90x70 --threads 1 --time 1 -o t.exr --aov samples "
             "--report r.json --balance " + balance, mpirun(2));
    CHECK(outcome.exit_code == 0);
    const Json report = report_in(dir, "r.json");
    CHECK(report["wall_s"] < 2.5);
    const Image image = read_image(dir / "t.exr");
    const std::vector<float> &samples = find_channel(image, "samples")->values;
    const std::set<float> counts(samples.begin(), samples.end());
    CHECK(counts.size() == 1);
    CHECK(static_cast<float>(report["spp"]) == *counts.begin());
  }
}

TEST_CASE("ranks: the report and the map say who rendered what") {
  if (!can_run_ranks()) return;
  const TempDir dir;
  const Outcome outcome = phalanx_in(
      dir, "render " + kGlass + " --quiet --size 96x64 --spp 16 --threads 1 -o a.exr --report r.json "
           "--balance rows --balance-map m.exr", mpirun(2));
  CHECK(outcome.exit_code == 0);
  const Json report = report_in(dir, "r.json");
  CHECK(report["imbalance"] >= 1.0);
  std::int64_t rays = 0;
  for (const Json &rank : report["per_rank"]) {
    CHECK(rank["busy_s"] > 0.0);
    CHECK(rank["tiles"] >= 1);
    CHECK(rank["lost"] == false);
    rays += static_cast<std::int64_t>(rank["rays"]);
  }
  const Json &kinds = report["rays"];
  CHECK(rays == static_cast<std::int64_t>(kinds["camera"]) + static_cast<std::int64_t>(kinds["bounce"]) +
                    static_cast<std::int64_t>(kinds["shadow"]));
  CHECK(kinds["camera"] == 96 * 64 * 16);
  const Image map = read_image(dir / "m.exr");
  const std::vector<float> &rank = find_channel(map, "rank")->values;
  for (int y = 0; y < 64; ++y) CHECK(rank[static_cast<std::size_t>(96 * y)] == (y < 32 ? 0.0f : 1.0f));
  for (const float cost : find_channel(map, "cost")->values) CHECK(cost > 0);
}

TEST_CASE("ranks: killed workers change nothing but the time, and are reported") {
  if (!can_run_ranks()) return;
  const TempDir dir;
  const std::string common = "render " + kGlass + " --quiet --size 150x130 --aov all --spp 300 --threads ";
  REQUIRE(phalanx_in(dir, common + "2 -o one.exr").exit_code == 0);
  for (const char *balance : {"dynamic", "rows"}) {
    CAPTURE(balance);
    std::filesystem::remove(dir / "c.ckpt");
    Background job(dir, common + "1 -o several.exr --report r.json --checkpoint c.ckpt "
                                 "--checkpoint-every 0.2 --balance " + balance,
                   mpirun(4, "--enable-recovery"));
    std::vector<pid_t> workers;
    for (const int rank : {1, 2, 3}) workers.push_back(job.rank(rank));
    for (const pid_t pid : workers) REQUIRE(pid > 0);
    REQUIRE(appears(dir / "c.ckpt"));  // they are rendering
    ::kill(workers[0], SIGKILL);
    Background::pause(0.1);
    ::kill(workers[2], SIGKILL);
    CHECK(job.wait(30) == 0);
    CHECK(same_pictures(dir / "one.exr", dir / "several.exr"));
    const Json report = report_in(dir, "r.json");
    CHECK(report["per_rank"][1]["lost"] == true);
    CHECK(report["per_rank"][2]["lost"] == false);
    CHECK(report["per_rank"][3]["lost"] == true);
    CHECK(report["warnings"].size() == 2);
    CHECK(report["spp"] == 300);
  }
}

TEST_CASE("ranks: a job that is terminated leaves image and checkpoint, and others go on from it") {
  if (!can_run_ranks()) return;
  const TempDir dir;
  const std::string common = "render " + kGlass + " --quiet --size 150x130 --aov all --spp 700";
  REQUIRE(phalanx_in(dir, common + " -o one.exr --threads 2").exit_code == 0);
  {
    Background job(dir, common + " --threads 1 -o a.exr --report r.json --checkpoint c.ckpt --checkpoint-every 0.05",
                   mpirun(2));
    REQUIRE(appears(dir / "c.ckpt"));
    job.signal(SIGTERM);
    CHECK(job.wait(10) != 0);
    REQUIRE(appears(dir / "a.exr", 2));
    CHECK(report_in(dir, "r.json")["stopped_by"] == "signal");
  }
  const std::string resumed = " --threads 1 -o b.exr --report r.json --checkpoint c.ckpt --resume --balance ";
  std::filesystem::copy_file(dir / "c.ckpt", dir / "kept");
  for (const char *balance : {"dynamic", "cost"}) {
    CAPTURE(balance);
    std::filesystem::copy_file(dir / "kept", dir / "c.ckpt",
                               std::filesystem::copy_options::overwrite_existing);
    CHECK(phalanx_in(dir, common + resumed + balance, mpirun(3)).exit_code == 0);
    CHECK(same_pictures(dir / "one.exr", dir / "b.exr"));
    CHECK(report_in(dir, "r.json")["stopped_by"] == "spp");
  }
}
