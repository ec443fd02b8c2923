// The words of the progress line.
#include "cli/progress.h"

#include <doctest/doctest.h>

#include <cmath>

#include "cli/text.h"

using namespace phalanx;

TEST_CASE("progress: a line in the middle of a rendering") {
  const Progress progress{128, 256, 0.45, 12.3, 102'090'000};
  CHECK(progress_line(progress, 3.1e-3) ==
        "[####......] 45 % | 12.3 s, 15.0 s left | 128/256 spp | 8.3 Mray/s | "
        "relMSE 3.1e-3");
}

TEST_CASE("progress: what is not known is left out") {
  CHECK(progress_line({}, NAN) == "[..........] 0 % | 0.0 s | 0 spp");
  CHECK(progress_line({8, 0, 1.0, 120, 0}, NAN) ==
        "[##########] 100 % | 120 s | 8 spp | 0.0 Mray/s");
}

TEST_CASE("progress: the summary") {
  RunStats stats;
  stats.spp = 64;
  stats.wall_s = 10;
  stats.setup_s = 0.5;
  stats.rays.camera = 25'000'000;
  CHECK(summary_line(stats, {3.1e-3, 2.7e-3, 3.6e-3, ""}) ==
        "64 spp in 10.0 s (0.5 s set-up) | 2.5 Mray/s | relMSE 3.1e-3 [2.7e-3, 3.6e-3]");
}

TEST_CASE("text: numbers for people") {
  CHECK(text_of_error(3.14159e-3) == "3.1e-3");
  CHECK(text_of_error(3.1e-12) == "3.1e-12");
  CHECK(text_of_error(12.0) == "1.2e+1");
  CHECK(text_of_error(0) == "0");
  CHECK(text_of_error(NAN) == "?");
  CHECK(text_of_bytes(1023) == "1023 B");
  CHECK(text_of_bytes(1536) == "1.5 KiB");
  CHECK(text_of_bytes(std::int64_t{3} << 30) == "3.0 GiB");
}
