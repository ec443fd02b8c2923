// How large the error of a picture is, without a reference: from the spread of its samples.
#pragma once
#include <string>

#include "../film/film.h"

namespace phalanx {

/// relMSE that the picture is expected to have against the truth, with a 95 % interval. NaN where it
/// is not known: the estimate needs two samples a pixel, the interval two tiles.
struct ErrorEstimate {
  double relmse;
  double lo95, hi95;
  std::string method;
};

/// Mean over pixels and channels of variance_of_mean / (mean^2 + eps), eps = (0.01 mean)^2, as
/// in ImageErrors::relmse. The interval is Student's t on the logarithm, over tiles of 16 x 16
/// pixels. Samples of a Sobol sequence are spread more evenly than their variance tells, so that
/// there the estimate is an upper bound: `stratified` only says so in `method`.
ErrorEstimate estimate_error(const Film &film, bool stratified);

}  // namespace phalanx
