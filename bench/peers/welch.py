"""Do two renderers compute the same picture? Welch's t-test, tile by tile, over independent runs.

Jung, Hanika, Dachsbacher, "Detecting Bias in Monte Carlo Renderers using Welch's t-test", JCGT 9:2,
2020: where both are unbiased, the p-values of the tiles are uniform in [0, 1]. Each run is one picture
with a seed of its own, so nothing is assumed about samples within a picture (Sobol's are not
independent). Bias makes small p-values; rare bright samples make the test shy, p-values too large, which
is no fault. Tiles without noise, such as a plain background, have no p-value: they must be equal.
"""
from dataclasses import dataclass

import numpy as np
from scipy import stats

NOISE_FREE = 1e-5  # standard error over value: nothing but rounding
ROUNDING = 1e-4    # largest relative difference of a tile without noise


@dataclass
class Comparison:
    ratio: np.ndarray              # [3] mean of a over mean of b
    ratio_error: np.ndarray        # [3] its standard error
    tile_p: list                   # for each channel the p-values of the tiles with noise
    num_quiet: int                 # tiles and channels without noise
    num_quiet_unequal: int
    uniformity_p: float            # Kolmogorov-Smirnov: no smaller than uniform; least of 3, times 3
    below_001: float               # share of p-values below 0.01
    outliers_p: float              # that so many are below 0.01; least of the channels, times 3


def tile_means(images, side):
    """[runs, height, width, 3] to [runs, num_tiles, 3]; what is left over at the edges is not used."""
    runs, height, width, _ = images.shape
    rows, columns = height // side, width // side
    tiles = images[:, :rows * side, :columns * side].reshape(runs, rows, side, columns, side, 3)
    return tiles.mean(axis=(2, 4), dtype=np.float64).reshape(runs, rows * columns, 3)


def mean_ratio(a, b):
    """Ratio of the means of two sets of pictures and its standard error, per channel."""
    a, b = (x.mean(axis=(1, 2), dtype=np.float64) for x in (a, b))
    relative = [x.std(axis=0, ddof=1) / np.sqrt(len(x)) / x.mean(axis=0) for x in (a, b)]
    ratio = a.mean(axis=0) / b.mean(axis=0)
    return ratio, ratio * np.hypot(*relative)


def quiet_tiles(a, b):
    """[num_tiles, 3]: which have no noise, and by how much they differ."""
    mean = [np.abs(x.mean(axis=0)) for x in (a, b)]
    error = [x.std(axis=0, ddof=1) / np.sqrt(len(x)) for x in (a, b)]
    largest = np.maximum(*mean)
    quiet = np.hypot(*error) <= NOISE_FREE * largest
    difference = np.abs(mean[0] - mean[1]) / np.where(largest > 0, largest, 1)
    return quiet, difference


def compare(a, b, side):
    """a, b: [runs, height, width, 3], linear RGB."""
    ratio, ratio_error = mean_ratio(a, b)
    tiles = [tile_means(x, side) for x in (a, b)]
    quiet, difference = quiet_tiles(*tiles)
    moments = [(x.mean(axis=0), x.std(axis=0, ddof=1), len(x)) for x in tiles]
    by_channel = [stats.ttest_ind_from_stats(
        *(m if np.isscalar(m) else m[~quiet[:, c], c] for side in moments for m in side),
        equal_var=False).pvalue for c in range(3)]
    loud = [x for x in by_channel if len(x) >= 5]
    uniformity = min([3 * stats.kstest(x, "uniform", alternative="greater").pvalue for x in loud],
                     default=1.0)
    outliers = min([3 * stats.binom.sf((x < 0.01).sum() - 1, len(x), 0.01) for x in loud],
                   default=1.0)
    every = np.concatenate(by_channel)
    return Comparison(ratio, ratio_error, by_channel, int(quiet.sum()),
                      int((quiet & (difference > ROUNDING)).sum()), float(min(1.0, uniformity)),
                      float((every < 0.01).mean()) if len(every) else 0.0,
                      float(min(1.0, outliers)))
