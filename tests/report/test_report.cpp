// The report is a contract: every key is always there.
#include "report/report.h"

#include <doctest/doctest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "report/comparison.h"

using namespace phalanx;
using Json = nlohmann::json;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Plan small_plan() {
  Plan plan;
  plan.frame.width = 320;
  plan.frame.height = 240;
  plan.crop = {10, 20, 30, 40};
  plan.kernels = {"generate", "intersect"};
  plan.columns = {{"beta", 12}, {"ray", 32}};
  plan.left_out = {{"shadow rays", "the scene has no lights", 20}};
  return plan;
}

}  // namespace

TEST_CASE("report: all keys are present even when nothing is known") {
  const Plan plan;
  const Report report{"", plan, {}, {kNan, kNan, kNan, "none"}, {}, 0};
  const Json json = Json::parse(report_json(report));
  for (const char *key :
       {"version",        "scene",       "mode",   "isa",          "threads", "ranks",   "width",
        "height",         "spp",         "seed",   "max_depth",    "wall_s",  "cpu_s",   "setup_s",
        "rays",           "mrays_per_s", "stages", "trace_only_s", "error",   "invalid", "plan",
        "peak_rss_bytes", "stopped_by",  "crop",   "clamp",        "balance",      "imbalance", "per_rank", "resumed_spp",
        "warnings"})
    CHECK_MESSAGE(json.contains(key), key);
  for (const char *key : {"camera", "bounce", "shadow"}) CHECK(json["rays"].contains(key));
  for (const char *key : {"relmse_estimate", "lo95", "hi95", "method"})
    CHECK(json["error"].contains(key));
  for (const char *key : {"count", "not_finite", "negative", "first"}) CHECK(json["invalid"].contains(key));
  for (const char *key : {"kernels", "left_out", "bytes_per_path"})
    CHECK(json["plan"].contains(key));
  CHECK(json["trace_only_s"].is_null());
  CHECK(json["error"]["relmse_estimate"].is_null());
  CHECK(json["invalid"]["first"].is_null());
  CHECK(json["stages"].is_array());
}

TEST_CASE("report: values arrive under their names") {
  const Plan plan = small_plan();
  RunStats stats;
  stats.wall_s = 2;
  stats.rays = {1'000'000, 2'000'000, 3'000'000};
  stats.stages = {{"shade", 0.5, 100, 60, 80}, {"film", 0.1, 100, 0, 0}};
  stats.invalid.add(5, 6, 7);
  stats.stopped_by = "time";
  const Report report{"a.json", plan, stats, {0.01, 0.009, 0.011, "m"}, 1.5, 4096};
  const Json json = Json::parse(report_json(report));
  CHECK(json["width"] == 320);
  CHECK(json["crop"] == Json({10, 20, 30, 40}));
  CHECK(json["mrays_per_s"] == 3.0);
  CHECK(json["rays"]["shadow"] == 3'000'000);
  CHECK(json["stages"][0]["utilisation"] == 0.75);
  CHECK(json["stages"][1]["utilisation"].is_null());
  CHECK(json["invalid"]["count"] == 1);
  CHECK(json["invalid"]["not_finite"] == 1);
  CHECK(json["invalid"]["first"]["x"] == 5);
  CHECK(json["invalid"]["first"]["y"] == 6);
  CHECK(json["invalid"]["first"]["sample"] == 7);
  const std::string replay = json["invalid"]["first"]["replay"];
  CHECK(replay.starts_with("phalanx replay a.json --pixel 5,6 --sample 7 --size 320x240"));
  CHECK(json["plan"]["bytes_per_path"] == 44);
  CHECK(json["plan"]["left_out"][0]["feature"] == "shadow rays");
  CHECK(json["error"]["lo95"] == 0.009);
  CHECK(json["trace_only_s"] == 1.5);
  CHECK(json["stopped_by"] == "time");
}

TEST_CASE("report: a scene name that is not UTF-8 does not break the JSON") {
  const Plan plan;
  const Report report{"b\xfcro.json", plan, {}, {kNan, kNan, kNan, ""}, {}, 0};
  CHECK(Json::parse(report_json(report)).contains("scene"));
}

TEST_CASE("report: metadata carries the facts as text") {
  const Plan plan = small_plan();
  RunStats stats;
  stats.mode = "wavefront";
  stats.spp = 64;
  const Metadata facts = report_metadata({"a.json", plan, stats, {0.5, kNan, kNan, ""}, {}, 0});
  Image image;
  image.metadata = facts;
  CHECK(find_metadata(image, "phalanx.mode") == "wavefront");
  CHECK(find_metadata(image, "phalanx.spp") == "64");
  CHECK(find_metadata(image, "phalanx.relmse_estimate") == "0.5");
}

TEST_CASE("comparison: text and JSON of images that share no layer") {
  Image image = make_image(2, 1), reference = make_image(2, 1);
  for (const char *name : {"R", "G", "B"}) {
    add_channel(image, name) = {1, 0};
    add_channel(reference, name) = {0, 0};
  }
  const Comparison comparison = compare(image, reference, false);
  const Json json = Json::parse(comparison_json(comparison));
  CHECK(json["mse"] == 0.5);
  CHECK(json["relmse"].is_null());  // infinite
  CHECK(json["welch"].is_null());
  CHECK(json["why_no_welch"].is_string());
  CHECK(json["flip"]["mean"].get<double>() > 0.1);
  CHECK(comparison_text(comparison).find("relMSE") != std::string::npos);
}
