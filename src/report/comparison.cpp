// Runs the metrics and writes them down twice: for people and for scripts.
#include "comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace phalanx {
namespace {

using Json = nlohmann::ordered_json;

std::string anomalies_text(const Anomalies &a) {
  return fmt::format("NaN {}, Inf {}, negative {}", a.nan, a.inf, a.negative);
}

Json anomalies_json(const Anomalies &a) {
  return {{"nan", a.nan}, {"inf", a.inf}, {"negative", a.negative}};
}

/// The smallest of three p-values, corrected for having looked at three (Bonferroni).
double combined(const std::array<double, 3> &p) {
  if (std::isnan(p[0])) return p[0];
  return std::min(1.0, 3 * *std::min_element(p.begin(), p.end()));
}

double smallest_tile_p(const WelchTest &test) {
  double p = 1;
  for (const auto &tiles : test.tile_p)
    p = std::min(p, *std::min_element(tiles.begin(), tiles.end()));
  return p;
}

std::string welch_text(const WelchTest &test) {
  std::string text;
  const auto line = [&](const char *name, const std::string &value) {
    text += fmt::format("{:<22}{}\n", name, value);
  };
  line("mean difference",
       fmt::format("{:+.4g} {:+.4g} {:+.4g} (R G B), p = {:.3g}", test.mean_difference[0],
                   test.mean_difference[1], test.mean_difference[2], combined(test.mean_p)));
  const double uniformity = combined(test.uniformity_p);
  line("Welch tiles", fmt::format("{} of 8 x 8 pixels, smallest p = {:.3g}", test.num_tiles,
                                  smallest_tile_p(test)));
  line("p-values uniform", std::isnan(uniformity) ? "not tested: needs 100 tiles"
                                                  : fmt::format("p = {:.3g}", uniformity));
  line("", "(Sobol points vary less than these tests assume: p-values then crowd towards 1)");
  return text;
}

Json welch_json(const WelchTest &test) {
  return {{"num_tiles", test.num_tiles},
          {"mean_difference", test.mean_difference},
          {"mean_p", test.mean_p},
          {"uniformity_p", test.uniformity_p},
          {"smallest_tile_p", smallest_tile_p(test)},
          {"tile_p", test.tile_p}};
}

Json flip_json(const FlipResult &flip) {
  return {{"mean", flip.mean},
          {"num_exposures", flip.num_exposures},
          {"first_exposure", flip.first_exposure},
          {"last_exposure", flip.last_exposure}};
}

}  // namespace

Comparison compare(const Image &image, const Image &reference, bool limited_range) {
  Comparison comparison;
  comparison.errors = compare_images(image, reference);
  if (comparison.errors.num_left_out == 0)
    comparison.flip = flip(image, reference, !limited_range);
  else
    comparison.why_no_flip = "the images have pixels that are not finite";
  comparison.welch = welch_test(image, reference, comparison.why_no_welch);
  return comparison;
}

std::string comparison_text(const Comparison &comparison) {
  const ImageErrors &e = comparison.errors;
  std::string text;
  const auto line = [&](const char *name, const std::string &value) {
    text += fmt::format("{:<22}{}\n", name, value);
  };
  const auto number = [](double x) { return fmt::format("{:.6g}", x); };
  line("image", comparison.image);
  line("reference", comparison.reference);
  line("pixels", fmt::format("{} compared, {} left out (not finite), {} differ", e.num_pixels,
                             e.num_left_out, e.num_different));
  line("image has", anomalies_text(e.image));
  line("reference has", anomalies_text(e.reference));
  line("mean", fmt::format("{:.6g} (reference {:.6g})", e.mean_image, e.mean_reference));
  line("MSE", number(e.mse));
  line("relMSE", number(e.relmse));
  line("relMSE, eps 0.01", number(e.relmse_literature));
  line("relMSE, trimmed", number(e.relmse_trimmed) + " (without the worst 0.1 % of pixels)");
  line("SMAPE", number(e.smape));
  line("relative error", fmt::format("p50 {:.4g}, p95 {:.4g}, p99.9 {:.4g}, max {:.4g}", e.p50,
                                     e.p95, e.p999, e.max));
  if (!comparison.flip)
    line("FLIP", "left out: " + comparison.why_no_flip);
  else if (comparison.flip->num_exposures == 1)
    line("FLIP", number(comparison.flip->mean));
  else
    line("HDR-FLIP", fmt::format("{:.6g} ({} exposures, {:+.2f} to {:+.2f} stops)",
                                 comparison.flip->mean, comparison.flip->num_exposures,
                                 comparison.flip->first_exposure, comparison.flip->last_exposure));
  if (comparison.welch)
    text += welch_text(*comparison.welch);
  else
    line("Welch's t-test", "left out: " + comparison.why_no_welch);
  return text;
}

std::string comparison_json(const Comparison &comparison) {
  const ImageErrors &e = comparison.errors;
  Json json = {
      {"image", comparison.image},
      {"reference", comparison.reference},
      {"num_pixels", e.num_pixels},
      {"num_left_out", e.num_left_out},
      {"num_different", e.num_different},
      {"image_anomalies", anomalies_json(e.image)},
      {"reference_anomalies", anomalies_json(e.reference)},
      {"mean_image", e.mean_image},
      {"mean_reference", e.mean_reference},
      {"mse", e.mse},
      {"relmse", e.relmse},
      {"relmse_eps_0.01", e.relmse_literature},
      {"relmse_trimmed", e.relmse_trimmed},
      {"smape", e.smape},
      {"relative_error", {{"p50", e.p50}, {"p95", e.p95}, {"p99.9", e.p999}, {"max", e.max}}}};
  json["flip"] = comparison.flip ? flip_json(*comparison.flip) : Json(nullptr);
  json["why_no_flip"] = comparison.flip ? Json(nullptr) : Json(comparison.why_no_flip);
  json["welch"] = comparison.welch ? welch_json(*comparison.welch) : Json(nullptr);
  json["why_no_welch"] = comparison.welch ? Json(nullptr) : Json(comparison.why_no_welch);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace phalanx
