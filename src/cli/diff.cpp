// phalanx diff: how far an image is from a reference.
#include <fmt/format.h>

#include <memory>

#include "../core/error.h"
#include "../output/image_file.h"
#include "../report/comparison.h"
#include "commands.h"
#include "outputs.h"

namespace phalanx {
namespace {

struct DiffCommand {
  std::string image, reference;
  std::vector<std::string> outputs;
  double exposure = 0;
  bool json = false;
};

/// The images, and the error in each pixel.
Image picture_of(const Comparison &comparison, const Image &image, const Image &reference) {
  Image difference = difference_image(image, reference);
  if (comparison.flip) add_channel(difference, "error.flip") = comparison.flip->error;
  return difference;
}

int run_diff(const DiffCommand &command) {
  const Outputs outputs{command.outputs, ""};
  for (const std::string &input : {command.image, command.reference})
    check_outputs(outputs, input, false);
  const Image image = read_image(command.image), reference = read_image(command.reference);
  const bool limited_range = image_format(command.image) == ImageFormat::kPng &&
                             image_format(command.reference) == ImageFormat::kPng;

  Comparison comparison = compare(image, reference, limited_range);
  comparison.image = command.image;
  comparison.reference = command.reference;
  fmt::print("{}", command.json ? comparison_json(comparison) : comparison_text(comparison));
  if (!command.outputs.empty())
    write_outputs(outputs, picture_of(comparison, image, reference), command.exposure, "");
  return kExitDone;
}

}  // namespace

void add_diff_command(CLI::App &app, int &exit_code) {
  auto command = std::make_shared<DiffCommand>();
  CLI::App *sub = app.add_subcommand("diff", "Compare an image with a reference");
  sub->add_option("A", command->image, "Image: .exr, .hdr or .png")->required();
  sub->add_option("B", command->reference, "Reference of the same size")->required();
  sub->add_option("-o,--output", command->outputs,
                  "Write |A - B|; an EXR also gets the layers error.relative and error.flip. "
                  "May be repeated")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  sub->add_option("--exposure", command->exposure, "Exposure of a PNG written with -o, in stops")
      ->type_name("STOPS");
  sub->add_flag("--json", command->json, "Print JSON");
  sub->footer(
      "Examples:\n"
      "  phalanx diff fast.exr reference.exr\n"
      "  phalanx diff fast.exr reference.exr -o difference.png --exposure 4");
  sub->callback([command, &exit_code] { exit_code = run_diff(*command); });
}

}  // namespace phalanx
