#include "ies.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "../core/error.h"
#include "json_value.h"
#include "number_text.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr int kMaxAngles = 100'000;       // each way
constexpr double kMaxValues = 4'000'000;  // of both ways together
constexpr double kMaxCandela = 1e30;

/// Numbers one after another, with the line of each.
class IesText {
 public:
  IesText(std::string_view text, const std::string &name) : text_(text), name_(name) {}

  [[noreturn]] void fail(const std::string &message) const {
    throw InputError({Problem{name_, line_, 0, "", message}});
  }

  /// The next line without its end; false at the end of the file.
  bool take_line(std::string_view &line) {
    if (text_.empty()) return false;
    ++line_;
    const size_t end = std::min(text_.find('\n'), text_.size());
    line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
    while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
    return true;
  }

  double number(const std::string &what) {
    while (rest_.empty())
      if (!take_line(rest_)) fail("the file ends before " + what);
    const size_t end = std::min(rest_.find_first_of(" \t\r\f\v,"), rest_.size());
    const std::string_view token = rest_.substr(0, end);
    rest_.remove_prefix(end);
    while (!rest_.empty() && is_space(rest_.front())) rest_.remove_prefix(1);
    double value = 0;
    if (parse_number(token, value) != NumberText::kGood)
      fail("expected " + what + ", found '" + printable(std::string(token)) + "'");
    return value;
  }

  int count(const std::string &what, int least, int most) {
    const double value = number(what);
    if (value < least || value > most || value != std::floor(value))
      fail("expected " + what + ", a whole number in [" + std::to_string(least) + ", " +
           std::to_string(most) + "]");
    return static_cast<int>(value);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

  std::string_view text_, rest_;
  const std::string &name_;
  int line_ = 0;
};

/// Skips the header; returns what TILT= says, in capitals.
std::string find_tilt(IesText &text) {
  std::string_view line;
  while (text.take_line(line)) {
    std::string capitals(line);
    for (char &c : capitals)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    if (capitals.starts_with("TILT=")) return capitals.substr(5);
  }
  text.fail("this is no IES photometric file: it has no line TILT=");
}

/// TILT=INCLUDE: how the lamp's position changes its light.
void skip_tilt(IesText &text) {
  text.number("the lamp's geometry");
  const int num_angles = text.count("the number of tilt angles", 0, kMaxAngles);
  for (int i = 0; i < 2 * num_angles; ++i) text.number("a tilt angle or factor");
}

std::vector<double> read_angles(IesText &text, int count, const std::string &what) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) {
    angles.push_back(text.number("a " + what));
    if (i > 0 && !(angles.back() > angles[static_cast<size_t>(i) - 1]))
      text.fail(what + "s must ascend");
  }
  return angles;
}

void check_angles(const IesText &text, const IesProfile &profile) {
  if (profile.vertical.front() < 0 || profile.vertical.back() > 180)
    text.fail("vertical angles must be within 0 and 180 degrees");
  const double first = profile.horizontal.front(), last = profile.horizontal.back();
  const bool from_zero = first == 0 && (last == 90 || last == 180 || last == 360);
  if (profile.horizontal.size() > 1 && !from_zero && !(first == 90 && last == 270))
    text.fail("horizontal angles must run from 0 to 90, 180 or 360 degrees, or from 90 to 270");
}

/// The interval of an ascending list that x is in, and how far, in [0, 1].
struct Place {
  size_t index;
  double offset;
};

Place find_place(const std::vector<double> &values, double x) {
  if (values.size() < 2) return {0, 0};
  const auto above = std::upper_bound(values.begin(), values.end(), x) - values.begin();
  const auto i = static_cast<size_t>(
      std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(values.size()) - 2));
  return {i, std::clamp((x - values[i]) / (values[i + 1] - values[i]), 0.0, 1.0)};
}

/// Into the part of the circle that the file has.
double fold(const std::vector<double> &horizontal, double angle) {
  double h = angle - 360 * std::floor(angle / 360);
  if (horizontal.back() == 360) return h;
  if (horizontal.front() == 90) return h < 90 ? 180 - h : h > 270 ? 540 - h : h;
  if (h > 180) h = 360 - h;
  return horizontal.back() == 90 && h > 90 ? 180 - h : h;
}

}  // namespace

IesProfile parse_ies(const std::string &bytes, const std::string &name) {
  IesText text(bytes, name);
  IesProfile profile;
  const std::string tilt = find_tilt(text);
  if (tilt == "INCLUDE") skip_tilt(text);
  profile.is_tilted = tilt != "NONE";
  text.number("the number of lamps");
  text.number("lumens per lamp");
  double factor = text.number("the candela multiplier");
  const int num_vertical = text.count("the number of vertical angles", 2, kMaxAngles);
  const int num_horizontal = text.count("the number of horizontal angles", 1, kMaxAngles);
  if (static_cast<double>(num_vertical) * num_horizontal > kMaxValues)
    text.fail("the file claims more than four million values");
  if (text.count("the photometric type", 1, 3) != 1)
    text.fail("photometric types A and B are not supported, only type C (1)");
  text.count("the unit of length", 1, 2);
  for (const char *what : {"the width", "the length", "the height"}) text.number(what);
  factor *= text.number("the ballast factor");
  factor *= text.number("the ballast-lamp factor");
  text.number("the input power");
  if (!(factor > 0)) text.fail("the candela multiplier and ballast factors must be above 0");
  profile.vertical = read_angles(text, num_vertical, "vertical angle");
  profile.horizontal = read_angles(text, num_horizontal, "horizontal angle");
  check_angles(text, profile);
  const auto num_values = static_cast<size_t>(num_vertical) * static_cast<size_t>(num_horizontal);
  for (size_t i = 0; i < num_values; ++i) {
    const double candela = text.number("candela value " + std::to_string(i + 1) + " of " +
                                       std::to_string(num_values)) *
                           factor;
    if (!(candela >= 0 && candela <= kMaxCandela))
      text.fail("candela values must be in [0, 1e30] after all factors");
    profile.candela.push_back(candela);
  }
  if (!(*std::max_element(profile.candela.begin(), profile.candela.end()) > 0))
    text.fail("the luminaire gives no light: all candela values are 0");
  return profile;
}

double ies_candela(const IesProfile &profile, double vertical, double horizontal) {
  if (vertical < profile.vertical.front() || vertical > profile.vertical.back()) return 0;
  const Place v = find_place(profile.vertical, vertical);
  const Place h = find_place(profile.horizontal, fold(profile.horizontal, horizontal));
  const size_t stride = profile.vertical.size(), next = profile.horizontal.size() > 1 ? stride : 0;
  const double *const c = &profile.candela[h.index * stride + v.index];
  return (c[0] * (1 - v.offset) + c[1] * v.offset) * (1 - h.offset) +
         (c[next] * (1 - v.offset) + c[next + 1] * v.offset) * h.offset;
}

IesTable make_ies_table(const IesProfile &profile) {
  IesTable table;
  table.num_vertical = 361;
  table.num_horizontal = profile.horizontal.size() > 1 ? 145 : 2;
  std::vector<double> candela;
  for (int v = 0; v < table.num_vertical; ++v)
    for (int h = 0; h < table.num_horizontal; ++h)
      candela.push_back(ies_candela(profile, 180.0 * v / (table.num_vertical - 1),
                                    360.0 * h / (table.num_horizontal - 1)));
  table.peak = *std::max_element(candela.begin(), candela.end());
  if (!(table.peak > 0)) return table;
  for (const double value : candela) table.values.push_back(static_cast<float>(value / table.peak));
  return table;
}

}  // namespace phalanx
