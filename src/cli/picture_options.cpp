// Text to numbers, with messages that say what was expected.
#include "picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <climits>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "../core/error.h"
#include "../scene/sampler_names.h"
#include "../wavefront/isa.h"

namespace phalanx {
namespace {

/// All of `text` as a decimal integer that fits an int.
std::optional<int> int_from_text(const std::string &text) {
  int value = 0;
  const char *end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || text.empty()) return std::nullopt;
  return value;
}

/// Exactly `count` integers of at least 0, separated by `separator`.
std::optional<std::vector<int>> ints_from_text(const std::string &text, char separator,
                                               std::size_t count) {
  std::vector<int> values;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    const auto value = int_from_text(text.substr(at, end - at));
    if (!value || *value < 0) return std::nullopt;
    values.push_back(*value);
    at = end + 1;
  }
  if (values.size() != count) return std::nullopt;
  return values;
}

[[noreturn]] void bad_value(const std::string &option, const std::string &expected,
                            const std::string &found) {
  throw InputError(fmt::format("{}: expected {}, found \"{}\"", option, expected, found));
}

/// An option that takes one integer in [lo, hi].
void add_int(CLI::App &command, const std::string &name, int lo, int hi, const std::string &help,
             std::function<void(int)> use) {
  const std::string expected = hi == INT_MAX ? fmt::format("a whole number from {}", lo)
                                             : fmt::format("a whole number from {} to {}", lo, hi);
  command
      .add_option_function<std::string>(
          name,
          [=](const std::string &text) {
            const auto value = int_from_text(text);
            if (!value || *value < lo || *value > hi) bad_value(name, expected, text);
            use(*value);
          },
          help)
      ->type_name("N");
}

/// An option whose text `read` understands, or refuses by returning false.
CLI::Option *add_text(CLI::App &command, const std::string &name, const std::string &type,
                      const std::string &expected, const std::string &help,
                      std::function<bool(const std::string &)> read) {
  return command
      .add_option_function<std::string>(
          name,
          [=](const std::string &text) {
            if (!read(text)) bad_value(name, expected, text);
          },
          help)
      ->type_name(type);
}

bool positive(const std::string &text, double &value) {
  return CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
}

std::string sampler_list() {
  std::string list;
  for (std::size_t i = 0; i < kSamplerNames.size(); ++i)
    list += fmt::format("{}{}", i == 0 ? "" : i + 1 == kSamplerNames.size() ? " or " : ", ",
                        kSamplerNames[i].first);
  return list;
}

std::string isa_list() { return fmt::format("{}", fmt::join(known_isas(), ", ")); }

void add_frame_options(CLI::App &command, RenderOptions &options) {
  add_text(command, "--size", "WxH", "WIDTHxHEIGHT in pixels, such as 640x480",
           "Size of the picture in pixels", [&options](const std::string &text) {
             const auto size = ints_from_text(text, 'x', 2);
             if (!size || (*size)[0] < 1 || (*size)[1] < 1) return false;
             options.width = (*size)[0];
             options.height = (*size)[1];
             return true;
           });
  add_text(command, "--crop", "X,Y,W,H", "X,Y,WIDTH,HEIGHT in pixels, such as 100,50,64,64",
           "Render this window of the picture only", [&options](const std::string &text) {
             const auto crop = ints_from_text(text, ',', 4);
             if (!crop || (*crop)[2] < 1 || (*crop)[3] < 1) return false;
             std::copy(crop->begin(), crop->end(), options.crop.begin());
             return true;
           });
  add_int(command, "--max-depth", 0, INT_MAX, "Scattering events after the camera",
          [&options](int n) { options.max_depth = n; });
}

void add_sampling_options(CLI::App &command, RenderOptions &options) {
  add_int(command, "--spp", 1, INT_MAX, "Samples per pixel",
          [&options](int n) { options.spp = n; });
  add_text(command, "--time", "SECONDS", "a number of seconds above 0",
           "Render whole passes until this time is used up, at least one",
           [&options](const std::string &text) { return positive(text, options.time_limit_s); });
  add_text(command, "--target-error", "RELMSE", "a relMSE above 0, such as 1e-3",
           "Render until the error is known to be at most this. Of --spp, --time and --target-error, the first "
           "that is reached ends the rendering; without --spp, the others alone",
           [&options](const std::string &text) { return positive(text, options.target_error); });
  add_text(command, "--sampler", "NAME", sampler_list(), "Sampler: " + sampler_list(),
           [&options](const std::string &text) {
             for (const auto &[name, kind] : kSamplerNames)
               if (text == name) options.sampler = kind;
             return options.sampler.has_value() && text == sampler_name(*options.sampler);
           });
  command.add_flag("--adaptive", options.adaptive,
                   "More samples for tiles where a pilot, which is thrown away, found more noise");
  add_int(command, "--seed", 0, INT_MAX, "Seed of the sampler",
          [&options](int n) { options.seed = n; });
}

/// --error and --replicates. What they mean together, and with --target-error, is known when all options
/// have been read.
void add_error_options(CLI::App &command, RenderOptions &options) {
  struct Wishes {
    std::optional<bool> error;
    std::optional<int> replicates;
  };
  const auto wishes = std::make_shared<Wishes>();
  add_text(command, "--error", "on|off", "on or off",
           "Split the samples over independent replicates, which tell the error while rendering; default: on with "
           "--target-error, otherwise off",
           [wishes](const std::string &text) {
             wishes->error = text == "on";
             return text == "on" || text == "off";
           });
  add_text(command, "--replicates", "N", "a power of two from 2 to 64",
           fmt::format("How many of them; default {}", kDefaultReplicates),
           [wishes](const std::string &text) {
             wishes->replicates = int_from_text(text);
             const int n = wishes->replicates.value_or(0);
             return n >= 2 && n <= 64 && (n & (n - 1)) == 0;
           });
  command.parse_complete_callback([wishes, &options] {
    const bool target = options.target_error > 0;
    if (wishes->error == false && (target || wishes->replicates))
      throw InputError(fmt::format("--error off: {} needs --error on",
                                   target ? "--target-error" : "--replicates"));
    if (wishes->error.value_or(target || wishes->replicates))
      options.replicates = wishes->replicates.value_or(kDefaultReplicates);
  });
}

void add_schedule_options(CLI::App &command, RenderOptions &options) {
  add_text(command, "--mode", "MODE", "wavefront, megakernel, depth-first or recursive",
           "Schedule: wavefront (default), megakernel, depth-first or recursive",
           [&options](const std::string &text) {
             const auto mode = mode_from_name(text);
             if (mode) options.mode = *mode;
             return mode.has_value();
           });
  command
      .add_option("--isa", options.isa,
                  "Instruction set: " + isa_list() + "; the best one here by default")
      ->type_name("NAME");
  add_int(command, "--threads", 0, 65536, "Threads; 0, the default, takes all",
          [&options](int n) { options.threads = n; });
  add_int(command, "--wave-size", 1, 1 << 24, "Paths in flight per thread",
          [&options](int n) { options.wave_size = n; });
  add_int(command, "--tile-size", 1, 1 << 14, "Side of a tile in pixels, a power of two",
          [&options](int n) {
            if ((n & (n - 1)) != 0) bad_value("--tile-size", "a power of two", std::to_string(n));
            options.tile_size = n;
          });
}

}  // namespace

void add_picture_options(CLI::App &command, std::string &scene, RenderOptions &options) {
  command.add_option("SCENE", scene, "Scene file")->required();
  add_sampling_options(command, options);
  add_error_options(command, options);
  add_frame_options(command, options);
  add_schedule_options(command, options);
}

}  // namespace phalanx
