// Nothing is rendered before it is known where the picture goes.
#include "outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "../core/error.h"
#include "../output/files.h"
#include "../output/image_file.h"

namespace phalanx {
namespace {

const char kStdout[] = "/dev/stdout";

std::vector<std::string> all_paths(const Outputs &outputs) {
  std::vector<std::string> paths = outputs.images;
  if (!outputs.report.empty()) paths.push_back(outputs.report == "-" ? kStdout : outputs.report);
  return paths;
}

bool holds_layers(const std::string &path) { return image_format(path) == ImageFormat::kExr; }

}  // namespace

Outputs choose_outputs(const std::string &scene, const std::vector<std::string> &images,
                       const std::string &report) {
  if (!images.empty()) return {images, report};
  const std::string stem = scene == "-" ? "scene" : std::filesystem::path(scene).stem().string();
  return {{stem + ".exr", stem + ".png"}, report};
}

void check_outputs(const Outputs &outputs, const std::string &scene, bool with_layers) {
  for (const std::string &path : outputs.images) image_format(path);  // throws if it is unknown
  if (with_layers && std::none_of(outputs.images.begin(), outputs.images.end(), holds_layers))
    throw InputError("--aov: layers are written to EXR files only; add -o FILE.exr");

  std::vector<std::string> seen;
  for (const std::string &path : all_paths(outputs)) {
    if (is_same_file(path, scene))
      throw InputError(path + ": this is the scene itself; choose another output");
    for (const std::string &other : seen)
      if (path == other || (is_same_file(path, other) && !is_device(path)))
        throw InputError(path + ": named twice as an output");
    check_output_path(path);
    seen.push_back(path);
  }
}

void write_outputs(const Outputs &outputs, const Image &image, double exposure,
                   const std::string &report) {
  std::string failures;
  const auto attempt = [&](auto write) {
    try {
      write();
    } catch (const WriteError &error) {
      failures += (failures.empty() ? "" : "\n") + std::string(error.what());
    }
  };
  for (const std::string &path : outputs.images)
    attempt([&] { write_image(path, image, exposure); });
  if (!outputs.report.empty())
    attempt([&] { write_file(outputs.report == "-" ? kStdout : outputs.report, report); });
  if (!failures.empty()) throw WriteError(failures);
}

}  // namespace phalanx
