#!/usr/bin/env python3
"""Render scenes with Phalanx and with Mitsuba 3 and test whether the pictures agree.

Each side renders RUNS pictures with seeds of their own. A scene agrees if the means of the whole
pictures differ by less than 0.3 % in every channel, with a standard error below 0.1 %, the p-values
of the tiles are not smaller than uniform ones (Kolmogorov-Smirnov, p above 0.01), and no more of them
are below 0.01 than chance allows (binomial, p above 0.002). Exit code 1 if a scene does not.
For each scene FOLDER gets a PNG: Phalanx, Mitsuba, their difference in standard errors.
"""
import argparse
import glob
import json
import os
import sys

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MEAN_TOLERANCE = 0.003
MEAN_ERROR_LIMIT = 0.001
UNIFORMITY_LIMIT = 0.01
OUTLIERS_LIMIT = 0.002
HEADER = (f"{'scene':24} {'mean ratio':>10} {'+-':>8} {'KS p':>7} {'p<.01':>6} {'few p':>7} "
          f"{'tiles':>6} {'ours s':>7} {'peer s':>7}  verdict")


def verdict(c):
    """'agree', 'noisy' if there are too few samples to say so, or what differs."""
    wrong = []
    if np.abs(c.ratio - 1).max() >= MEAN_TOLERANCE:
        wrong.append("mean")
    if c.uniformity_p <= UNIFORMITY_LIMIT:
        wrong.append("tiles")
    if c.outliers_p <= OUTLIERS_LIMIT:
        wrong.append("some tiles")
    if c.num_quiet_unequal > 0:
        wrong.append("plain tiles")
    if wrong:
        return "differ: " + ", ".join(wrong)
    return "agree" if c.ratio_error.max() < MEAN_ERROR_LIMIT else "noisy"


def num_tiles(comparison):
    return max(len(p) for p in comparison.tile_p)


def row(result):
    c = result["comparison"]
    worst = np.argmax(np.abs(c.ratio - 1))
    return (f"{result['name']:24} {c.ratio[worst]:10.5f} {c.ratio_error[worst]:8.5f} "
            f"{c.uniformity_p:7.4f} {c.below_001:6.3f} {c.outliers_p:7.4f} {num_tiles(c):6d} "
            f"{result['phalanx_s']:7.1f} {result['mitsuba_s']:7.1f}  {result['verdict']}")


def side_by_side(path, ours, peer):
    """sRGB of both at the same exposure, then (ours - peer) / standard error: red ours is brighter,
    blue it is darker, full colour at 5."""
    import mitsuba as mi
    from welch import NOISE_FREE
    means = [x.mean(axis=0) for x in (ours, peer)]
    grey = [x.mean(axis=3) for x in (ours, peer)]
    error = np.sqrt(sum(x.var(axis=0, ddof=1) / len(x) for x in grey))
    grey = [x.mean(axis=0) for x in grey]
    z = (grey[0] - grey[1]) / np.maximum(error, NOISE_FREE * grey[1] + 1e-12)
    z = np.clip(z / 5, -1, 1)[..., None]
    colours = np.where(z > 0, 1 - z * [0, 1, 1], 1 + z * [1, 1, 0])
    white = max(np.percentile(means[1], 95), 1e-6)
    linear = np.clip(np.hstack(means) / white, 0, 1)
    srgb = np.where(linear < 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    picture = np.hstack([srgb, colours]) * 255 + 0.5
    mi.Bitmap(picture.astype(np.uint8)).write(path)


def check(path, options):
    from renderers import comparable, mitsuba_pictures, phalanx_pictures
    from welch import compare
    with open(path) as file:
        scene = json.load(file)
    name = os.path.splitext(os.path.basename(path))[0]
    folder = os.path.abspath(os.path.join(options.output, name))
    os.makedirs(folder, exist_ok=True)
    size = tuple(int(n) for n in options.size.split("x"))
    scene = comparable(scene, size, os.path.dirname(os.path.abspath(path)))
    peer, mitsuba_s = mitsuba_pictures(scene, folder, options)
    ours, phalanx_s = phalanx_pictures(options.program, scene, folder, options)
    comparison = compare(ours, peer, options.tile)
    side_by_side(os.path.join(options.output, name + ".png"), ours, peer)
    return {"name": name, "comparison": comparison, "verdict": verdict(comparison),
            "phalanx_s": phalanx_s, "mitsuba_s": mitsuba_s}


def as_json(result):
    c = result["comparison"]
    return {k: v for k, v in result.items() if k != "comparison"} | {
        "mean_ratio": c.ratio.tolist(), "mean_ratio_error": c.ratio_error.tolist(),
        "uniformity_p": c.uniformity_p, "share_below_0.01": c.below_001,
        "outliers_p": c.outliers_p,
        "num_tiles": num_tiles(c), "num_quiet": c.num_quiet,
        "num_quiet_unequal": c.num_quiet_unequal}


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/phalanx"))
    parser.add_argument("--size", default="128x128", metavar="WxH")
    parser.add_argument("--runs", type=int, default=16, help="pictures on each side")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel and picture")
    parser.add_argument("--seed", type=int, default=1, help="of the first picture")
    parser.add_argument("--tile", type=int, default=8, help="side of a tile, pixels")
    parser.add_argument("--threads", type=int, default=0, help="of both; 0: all")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba")
    parser.add_argument("--plain", action="store_true", help="leave Mitsuba's rough surfaces as they "
                        "are, instead of giving them the masking and the base of Phalanx's")
    parser.add_argument("-o", "--output", default=os.path.join(ROOT, "out/peers"), metavar="FOLDER")
    return parser.parse_args(arguments)


def use_own_llvm():
    """Makes Mitsuba take the LLVM that bench/peers/setup unpacked, unless the environment names one."""
    found = glob.glob(os.path.join(ROOT, ".deps/peers/llvm/usr/lib/*/libLLVM*.so*"))
    if found:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", found[0])


def main(arguments=None):
    options = parse(arguments)
    use_own_llvm()
    import mitsuba as mi
    mi.set_variant(options.variant)
    if options.threads > 0:
        import drjit
        drjit.set_thread_count(options.threads)
    from conserving_coat import ConservingCoat
    from correlated_masking import CorrelatedMasking
    from renderers import Failed
    from scene_keys import Unsupported
    mi.register_bsdf("correlated_masking", CorrelatedMasking)
    mi.register_bsdf("conserving_coat", ConservingCoat)
    os.makedirs(options.output, exist_ok=True)
    results, failed = [], False
    print(HEADER, flush=True)
    for scene in options.scenes:
        try:
            results.append(check(scene, options))
            print(row(results[-1]), flush=True)
        except (Unsupported, Failed) as problem:
            print(f"{scene}: {problem}", file=sys.stderr, flush=True)
            failed = True
    path = os.path.join(options.output, "crosscheck.json")
    with open(path, "w") as file:
        settings = {k: getattr(options, k) for k in
                    ("size", "runs", "spp", "seed", "tile", "variant", "plain")}
        json.dump({"mitsuba": mi.__version__, "settings": settings,
                   "scenes": [as_json(r) for r in results]}, file, indent=1)
    return 1 if failed or any(r["verdict"] != "agree" for r in results) else 0


if __name__ == "__main__":
    sys.exit(main())
