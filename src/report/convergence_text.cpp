// Tables, JSON and CSV of error against run time.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "convergence.h"

namespace phalanx {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double x) { return std::isnan(x) ? "-" : fmt::format("{:.3g}", x); }

std::string interval(const Interval95 &i, int digits = 3) {
  if (std::isnan(i.value)) return "-";
  std::string text = fmt::format("{:.{}g}", i.value, digits);
  if (!std::isnan(i.lo)) text += fmt::format(" [{:.{}g}, {:.{}g}]", i.lo, digits, i.hi, digits);
  return text;
}

/// As asked for, or with adaptive sampling as many as they were.
std::string number_of_samples(const CurvePoint &p) {
  return p.samples_per_pixel == p.spp ? fmt::format("{}", p.spp) : fmt::format("{:.1f}", p.samples_per_pixel);
}

std::string curve_text(const Curve &curve, const CurveFigures &figures) {
  std::string text = curve.name() + "\n";
  text += fmt::format("  {:>7} {:>9} {:>9}  {:<28} {:>9} {:>9} {:>8} {:>8} {:>9} {:>8} {:>8} {:>9}\n", "spp",
                      "seconds", "cpu s", "relMSE [95 %]", "trimmed", "MSE", "SMAPE", "FLIP", "estimate",
                      "est/true", "covers", "1/(E t)");
  for (const CurvePoint &p : figures.points)
    text += fmt::format("  {:>7} {:>9} {:>9}  {:<28} {:>9} {:>9} {:>8} {:>8} {:>9} {:>8} {:>8} {:>9}\n",
                        number_of_samples(p), number(p.wall_s), number(p.cpu_s), interval(p.relmse),
                        number(p.relmse_trimmed), number(p.mse), number(p.smape), number(p.flip),
                        number(p.estimate), number(p.estimate / p.relmse.value), number(p.coverage),
                        number(p.efficiency));
  text += fmt::format("  slope {}{}\n", interval(figures.slope),
                      figures.slope.value > -0.9 ? ": flatter than -0.9, a heavy tail or a bias" : "");
  const double last = figures.points.back().relmse.value;
  text += fmt::format("  bias  {} of the last relMSE; of the image mean {} %\n",
                      interval({curve.squared_bias.value / last, curve.squared_bias.lo / last,
                                curve.squared_bias.hi / last}),
                      interval({100 * curve.mean_bias.value, 100 * curve.mean_bias.lo,
                                100 * curve.mean_bias.hi}));
  return text;
}

std::string targets_text(const SceneConvergence &scene, const std::vector<CurveFigures> &figures) {
  std::string text;
  for (std::size_t t = 0; t < scene.targets.size(); ++t) {
    text += fmt::format("seconds to relMSE {:g}\n", scene.targets[t]);
    for (std::size_t c = 0; c < scene.curves.size(); ++c)
      text += fmt::format("  {:<28} {}\n", scene.curves[c].name(), interval(figures[c].seconds_to[t]));
  }
  return text;
}

std::string versus_text(const SceneConvergence &scene) {
  if (scene.curves.size() < 2) return "";
  std::string text = fmt::format("against {}\n", scene.curves[0].name());
  for (std::size_t c = 1; c < scene.curves.size(); ++c) {
    const Versus v = versus(scene.curves[0], scene.curves[c]);
    text += fmt::format("  {:<28} speed-up to relMSE {:.2g}: {};  relMSE after {:.3g} s: {} times\n",
                        scene.curves[c].name(), v.at_error, interval(v.speed_up), v.at_s,
                        interval(v.error_ratio));
  }
  return text;
}

Json interval_json(const Interval95 &i) { return {{"value", i.value}, {"lo95", i.lo}, {"hi95", i.hi}}; }

Json run_json(const std::vector<RunPoint> &run) {
  Json list = Json::array();
  for (const RunPoint &p : run)
    list.push_back({{"spp", p.spp}, {"samples_per_pixel", p.samples_per_pixel}, {"wall_s", p.wall_s},
                    {"cpu_s", p.cpu_s}, {"rays", p.rays}, {"relmse", p.error.relmse},
                    {"relmse_trimmed", p.error.relmse_trimmed}, {"mse", p.error.mse},
                    {"smape", p.error.smape}, {"flip", p.flip}, {"estimate", p.estimate},
                    {"estimate_lo95", p.lo95}, {"estimate_hi95", p.hi95}});
  return list;
}

Json points_json(const std::vector<CurvePoint> &points) {
  Json list = Json::array();
  for (const CurvePoint &p : points)
    list.push_back({{"spp", p.spp}, {"samples_per_pixel", p.samples_per_pixel}, {"wall_s", p.wall_s},
                    {"cpu_s", p.cpu_s}, {"rays", p.rays}, {"relmse", p.relmse.value},
                    {"lo95", p.relmse.lo}, {"hi95", p.relmse.hi}, {"relmse_trimmed", p.relmse_trimmed},
                    {"mse", p.mse}, {"smape", p.smape}, {"flip", p.flip}, {"estimate", p.estimate},
                    {"coverage", p.coverage}, {"efficiency", p.efficiency}});
  return list;
}

Json curve_json(const SceneConvergence &scene, std::size_t c) {
  const Curve &curve = scene.curves[c];
  const CurveFigures figures = curve_figures(curve, scene.targets);
  Json runs = Json::array(), seconds_to = Json::array();
  for (const auto &run : curve.runs) runs.push_back(run_json(run));
  for (std::size_t t = 0; t < scene.targets.size(); ++t) {
    Json entry = interval_json(figures.seconds_to[t]);
    entry["relmse"] = scene.targets[t];
    seconds_to.push_back(entry);
  }
  Json json = {{"mode", mode_name(curve.mode)},
               {"sampler", curve.sampler},
               {"points", points_json(figures.points)},
               {"slope", interval_json(figures.slope)},
               {"squared_bias", interval_json(curve.squared_bias)},
               {"image_mean_bias", interval_json(curve.mean_bias)},
               {"seconds_to", seconds_to}};
  if (c > 0) {
    const Versus v = versus(scene.curves[0], curve);
    json["versus_first"] = {{"at_relmse", v.at_error}, {"speed_up", interval_json(v.speed_up)},
                            {"at_s", v.at_s}, {"relmse_ratio", interval_json(v.error_ratio)}};
  }
  json["runs"] = runs;
  return json;
}

}  // namespace

std::string convergence_text(const SceneConvergence &scene) {
  std::string text = fmt::format(
      "{}: {} x {}, depth {}, {}, {} thread{}, {} seeds, set-up {:.3g} s\nreference: {}\n", scene.scene,
      scene.width, scene.height, scene.max_depth, scene.isa, scene.threads, scene.threads == 1 ? "" : "s",
      scene.curves.front().runs.size(), scene.setup_s, scene.reference);
  std::vector<CurveFigures> figures;
  for (const Curve &curve : scene.curves) {
    figures.push_back(curve_figures(curve, scene.targets));
    text += curve_text(curve, figures.back());
  }
  return text + targets_text(scene, figures) + versus_text(scene);
}

std::string convergence_summary_text(const std::vector<SceneConvergence> &scenes) {
  if (scenes.size() < 2 || scenes.front().curves.size() < 2) return "";
  std::string text = fmt::format("geometric means over {} scenes, against {}\n", scenes.size(),
                                 scenes.front().curves.front().name());
  for (std::size_t c = 1; c < scenes.front().curves.size(); ++c) {
    double log_speed_up = 0, log_ratio = 0;
    for (const SceneConvergence &scene : scenes) {
      const Versus v = versus(scene.curves[0], scene.curves[c]);
      log_speed_up += std::log(v.speed_up.value) / static_cast<double>(scenes.size());
      log_ratio += std::log(v.error_ratio.value) / static_cast<double>(scenes.size());
    }
    text += fmt::format("  {:<28} speed-up to equal error {:.3g}, relMSE after equal time {:.3g} times\n",
                        scenes.front().curves[c].name(), std::exp(log_speed_up), std::exp(log_ratio));
  }
  return text;
}

std::string convergence_json(const std::vector<SceneConvergence> &scenes) {
  Json list = Json::array();
  for (const SceneConvergence &scene : scenes) {
    Json curves = Json::array();
    for (std::size_t c = 0; c < scene.curves.size(); ++c) curves.push_back(curve_json(scene, c));
    list.push_back({{"scene", scene.scene}, {"width", scene.width}, {"height", scene.height},
                    {"max_depth", scene.max_depth}, {"isa", scene.isa}, {"threads", scene.threads},
                    {"replicates", scene.replicates}, {"adaptive", scene.adaptive},
                    {"setup_s", scene.setup_s}, {"reference", scene.reference}, {"curves", curves}});
  }
  return Json{{"scenes", list}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string convergence_csv(const std::vector<SceneConvergence> &scenes) {
  std::string text =
      "scene,mode,sampler,spp,wall_s,cpu_s,setup_s,rays,relmse,lo95,hi95,relmse_trimmed,mse,smape,flip,"
      "estimate,coverage,efficiency\n";
  const auto cell = [](double x) { return std::isnan(x) ? "" : fmt::format("{:.9g}", x); };
  for (const SceneConvergence &scene : scenes)
    for (const Curve &curve : scene.curves)
      for (const CurvePoint &p : curve_figures(curve, {}).points) {
        std::string name = scene.scene;
        for (std::size_t at = 0; (at = name.find('"', at)) != std::string::npos; at += 2) name.insert(at, 1, '"');
        text += fmt::format("\"{}\",{},{},{}", name, mode_name(curve.mode), curve.sampler, p.spp);
        for (const double x : {p.wall_s, p.cpu_s, scene.setup_s, p.rays, p.relmse.value, p.relmse.lo,
                               p.relmse.hi, p.relmse_trimmed, p.mse, p.smape, p.flip, p.estimate,
                               p.coverage, p.efficiency})
          text += "," + cell(x);
        text += "\n";
      }
  return text;
}

}  // namespace phalanx
