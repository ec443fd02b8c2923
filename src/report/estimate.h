// How large the error of a picture is, without a reference: from the spread of its samples.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "../film/film.h"
#include "../film/replicates.h"

namespace phalanx {

/// relMSE that the picture is expected to have against the truth, with a 95 % interval. NaN where it
/// is not known: the estimate needs two samples a pixel, the interval two tiles.
struct ErrorEstimate {
  double relmse;
  double lo95, hi95;
  std::string method;
  // Only from replicates: Student's t over their means of the whole picture, all channels together.
  int replicates = 0;
  double image_mean = std::numeric_limits<double>::quiet_NaN();
  double image_mean_half_width = std::numeric_limits<double>::quiet_NaN();  // of the 95 % interval
};

/// Mean over pixels and channels of variance_of_mean / (mean^2 + eps), eps = (0.01 mean)^2, as
/// in ImageErrors::relmse. The interval is Student's t on the logarithm, over tiles of 16 x 16
/// pixels. Samples of a Sobol sequence are spread more evenly than their variance tells, so that
/// there the estimate is an upper bound: `stratified` only says so in `method`.
ErrorEstimate estimate_error(const Film &film, bool stratified);

/// From the spread of replicates. The mean over pixels and channels of v / (r^2 + eps): v is the variance of
/// the mean of the R replicates, eps as above. The pixel's own mean would not do for r: where a rare bright
/// sample makes v large, it makes the mean large, too, and the quotient small. So r is between the pixel's
/// mean and the average of its neighbours, nearer to these the larger v is against their spread
/// (James and Stein 1961; Lee, "Digital image enhancement and noise filtering by use of local statistics",
/// 1980), and what bias is left is reduced by the jackknife over replicates (Quenouille 1956).
///
/// The interval is on the logarithm. Its half width is the root of the sum of squares of a statistical part,
/// Student's t with R - 1 degrees of freedom times the jackknife's standard error (Tukey 1958); a systematic
/// one, half of what all this has changed against own means; and 7 % for rare paths that other seeds would
/// have seen, chosen so that 95 % of the intervals hold on the scenes of docs/error.md. NaN with two
/// replicates. It is about the error that such pictures have on average. What no replicate has seen, it
/// cannot know.
ErrorEstimate estimate_error(const Replicates &replicates, int threads);

/// A tile of 8 x 8 pixels, cut off at the right and the bottom. x, y: in the full picture.
struct TileError {
  int x = 0, y = 0;
  double mean = 0;        // of its pixels, all channels
  double half_width = 0;  // of the 95 % interval of the mean, Student's t over replicates
  double relmse = 0;      // estimate for its pixels, as above but with their own means below
};
/// Row by row.
std::vector<TileError> tile_errors(const Replicates &replicates);

}  // namespace phalanx
