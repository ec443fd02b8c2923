// IES photometric files: what good ones mean, and a clear message for each way to be bad.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../../src/core/error.h"
#include "../../src/scene/ies.h"

using namespace phalanx;

namespace {

const std::string kHeader = "IESNA:LM-63-2002\r\n[TEST] none\r\n[MANUFAC] a, b\r\n";

/// A file of one row of angles each way.
std::string file(const std::string &vertical, const std::string &horizontal,
                 const std::string &candela, int num_vertical, int num_horizontal,
                 const std::string &tilt = "TILT=NONE\n") {
  return kHeader + tilt + "1 1000 2 " + std::to_string(num_vertical) + " " +
         std::to_string(num_horizontal) + " 1 2 0.1 0.2 0.3\n1.5 1 100\n" + vertical + "\n" +
         horizontal + "\n" + candela + "\n";
}
const std::string kGood = file("0 45 90", "0", "100 50 0", 3, 1);

std::string error_of(const std::string &text) {
  try {
    parse_ies(text, "lamp.ies");
  } catch (const InputError &error) {
    return error.problems()[0].text();
  }
  return "no error";
}

void check_error(const std::string &text, const std::string &expected) {
  const std::string error = error_of(text);
  INFO(error);
  CHECK(error.find(expected) != std::string::npos);
}

std::string replaced(std::string text, const std::string &from, const std::string &to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("ies: all factors apply, values between angles are linear, none beyond them") {
  const IesProfile profile = parse_ies(kGood, "lamp.ies");
  CHECK(profile.candela == std::vector<double>{300, 150, 0});  // times 2 and 1.5
  CHECK(!profile.is_tilted);
  CHECK(ies_candela(profile, 0, 123) == 300);
  CHECK(ies_candela(profile, 30, 0) == doctest::Approx(200));
  CHECK(ies_candela(profile, 67.5, 0) == doctest::Approx(75));
  CHECK(ies_candela(profile, 91, 0) == 0);
}

TEST_CASE("ies: quarters, halves and lateral halves are mirrored; a full circle is not") {
  const auto at = [](const IesProfile &profile, double horizontal) {
    return ies_candela(profile, 0, horizontal) / 3;
  };
  const IesProfile quarter = parse_ies(file("0 90", "0 90", "1 0 2 0", 2, 2), "lamp.ies");
  for (const double h : {0.0, 180.0, 360.0, -180.0}) CHECK(at(quarter, h) == doctest::Approx(1));
  for (const double h : {90.0, 270.0, -90.0}) CHECK(at(quarter, h) == doctest::Approx(2));
  CHECK(at(quarter, 135) == doctest::Approx(1.5));
  const IesProfile half = parse_ies(file("0 90", "0 90 180", "1 0 2 0 3 0", 2, 3), "lamp.ies");
  CHECK(at(half, 180) == doctest::Approx(3));
  CHECK(at(half, 225) == doctest::Approx(2.5));
  CHECK(at(half, 270) == doctest::Approx(2));
  const IesProfile lateral = parse_ies(file("0 90", "90 180 270", "1 0 2 0 3 0", 2, 3), "lamp.ies");
  CHECK(at(lateral, 0) == doctest::Approx(2));
  CHECK(at(lateral, 45) == doctest::Approx(1.5));
  CHECK(at(lateral, 315) == doctest::Approx(2.5));
  const IesProfile full =
      parse_ies(file("0 90", "0 90 180 270 360", "1 0 2 0 3 0 4 0 1 0", 2, 5), "lamp.ies");
  CHECK(at(full, 315) == doctest::Approx(2.5));
  CHECK(at(full, 405) == doctest::Approx(1.5));
}

TEST_CASE(
    "ies: older headers, any line breaks, commas, tilts and what follows the numbers are taken") {
  CHECK(error_of(replaced(kGood, "IESNA:LM-63-2002\r\n", "")) == "no error");
  CHECK(error_of(replaced(kGood, "TILT=NONE", "tilt=none")) == "no error");
  CHECK(error_of(kGood + "\x1a\n") == "no error");
  std::string broken = kGood;
  std::replace(broken.begin() + static_cast<std::ptrdiff_t>(broken.find("1 1000")), broken.end(),
               ' ', '\n');
  CHECK(parse_ies(broken, "").candela == parse_ies(kGood, "").candela);
  std::replace(broken.begin() + static_cast<std::ptrdiff_t>(broken.find("1\n1000")), broken.end(),
               '\n', ',');
  CHECK(parse_ies(broken, "").candela == parse_ies(kGood, "").candela);
  const IesProfile tilted =
      parse_ies(file("0 90", "0", "1 1", 2, 1, "TILT=INCLUDE\n1\n2\n0 90\n1 0.9\n"), "lamp.ies");
  CHECK(tilted.is_tilted);
  CHECK(tilted.candela.size() == 2);
  CHECK(parse_ies(file("0 90", "0", "1 1", 2, 1, "TILT=lamp.tlt\n"), "").is_tilted);
}

TEST_CASE("ies: every bad file gets one message with line and cause") {
  check_error("", "lamp.ies: this is no IES photometric file");
  check_error("{\"version\": 1}", "it has no line TILT=");
  check_error(kHeader + "TILT=NONE\n", "lamp.ies:4: the file ends before the number of lamps");
  check_error(kHeader + "TILT=NONE\n1 1000 x 3",
              "lamp.ies:5: expected the candela multiplier, found 'x'");
  check_error(replaced(kGood, " 3 1 1 2", " 3.5 1 1 2"),
              "lamp.ies:5: expected the number of vertical angles");
  check_error(replaced(kGood, " 3 1 1 2", " 1 1 1 2"), "a whole number in [2, ");
  check_error(replaced(kGood, " 3 1 1 2", " 3 0 1 2"), "expected the number of horizontal angles");
  check_error(replaced(kGood, " 3 1 1 2", " -3 1 1 2"), "expected the number of vertical angles");
  check_error(replaced(kGood, " 3 1 1 2", " 99999 99999 1 2"), "more than four million values");
  check_error(replaced(kGood, " 3 1 1 2", " 3 1 2 2"), "types A and B are not supported");
  check_error(replaced(kGood, " 3 1 1 2", " 3 1 4 2"), "expected the photometric type");
  check_error(replaced(kGood, " 3 1 1 2", " 3 1 1 3"), "expected the unit of length");
  check_error(replaced(kGood, "1 1000 2", "1 1000 0"), "must be above 0");
  check_error(replaced(kGood, "1.5 1 100", "-1 1 100"), "must be above 0");
  check_error(replaced(kGood, "0 45 90", "0 90 45"), "lamp.ies:7: vertical angles must ascend");
  check_error(replaced(kGood, "0 45 90", "0 45 45"), "must ascend");
  check_error(replaced(kGood, "0 45 90", "0 45 190"), "within 0 and 180 degrees");
  check_error(replaced(kGood, "0 45 90", "-1 45 90"), "within 0 and 180 degrees");
  check_error(replaced(kGood, "100 50 0", "100 50"),
              "lamp.ies:9: the file ends before candela value 3 of 3");
  check_error(replaced(kGood, "100 50 0", "100 nan 0"),
              "expected candela value 2 of 3, found 'nan'");
  check_error(replaced(kGood, "100 50 0", "100 1e999 0"), "expected candela value 2 of 3");
  check_error(replaced(kGood, "100 50 0", "100 1e37 0"), "in [0, 1e30]");
  check_error(replaced(kGood, "100 50 0", "100 -1 0"), "in [0, 1e30]");
  check_error(replaced(kGood, "100 50 0", "0 0 0"), "gives no light");
  check_error(file("0 90", "0 45", "1 1 1 1", 2, 2), "horizontal angles must run");
  check_error(file("0 90", "10 360", "1 1 1 1", 2, 2), "horizontal angles must run");
  check_error(file("0 90", "0", "1 1", 2, 1, "TILT=INCLUDE\n1 -2\n"),
              "expected the number of tilt angles");
}

TEST_CASE("ies: a file cut anywhere or changed in any byte does not crash") {
  const std::string text = file("0 30 60 90", "0 90", "1 2 3 4 5 6 7 8", 4, 2);
  for (std::size_t length = 0; length < text.size(); ++length) error_of(text.substr(0, length));
  unsigned state = 1;
  for (int i = 0; i < 20000; ++i) {
    state = state * 1664525u + 1013904223u;
    std::string changed = text;
    changed[(state >> 8) % text.size()] = static_cast<char>(state >> 24);
    try {
      const IesProfile profile = parse_ies(changed, "");
      for (const double h : {-500.0, 0.0, 77.0, 1e6})
        CHECK(std::isfinite(ies_candela(profile, 33, h)));
    } catch (const InputError &) {
    }
  }
}

TEST_CASE("ies: the table keeps the peak and the shape") {
  const IesTable table = make_ies_table(parse_ies(file("0 90", "0 90", "1 0 2 0", 2, 2), ""));
  CHECK(table.num_vertical == 361);
  CHECK(table.num_horizontal == 145);
  REQUIRE(table.values.size() == 361 * 145);
  CHECK(table.peak == doctest::Approx(6));
  CHECK(table.values[0] == 0.5f);          // 0 down, 0 around
  CHECK(table.values[36] == 1.0f);         // 90 around
  CHECK(table.values[90 * 145] == 0.25f);  // 45 down
  CHECK(table.values[300 * 145 + 36] == 0.0f);
  for (std::size_t v = 0; v < 361; ++v) CHECK(table.values[v * 145] == table.values[v * 145 + 144]);
  CHECK(make_ies_table(parse_ies(kGood, "")).num_horizontal == 2);
  CHECK(make_ies_table(parse_ies(file("0.1 0.2 0.3", "0", "0 1 0", 3, 1), "")).peak == 0);
}
