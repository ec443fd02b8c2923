#!/usr/bin/env python3
"""Times ranks against one rank, in pairs, and compares strategies and the simulator with what was measured.

Usage: measure.py PROGRAM SIMULATOR [--ranks 2] [--runs 5] [--size 256x256] [--spp 64] [--out DIR] [SCENE...]

Each turn renders a scene with one rank and then with every strategy on several ranks, one thread each. Printed: the median
of the ratios of the turns (speed-up) with its range, the median imbalance (busiest rank over the mean), and what the
simulator says for the map of costs that the first run left. Raw figures go to DIR/ranks.json.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys

STRATEGIES = ["dynamic", "cost", "rows", "columns", "grid", "bbox"]
ROOT = pathlib.Path(__file__).resolve().parents[2]


def parse():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("program")
    p.add_argument("simulator")
    p.add_argument("scenes", nargs="*")
    p.add_argument("--ranks", type=int, default=2)
    p.add_argument("--runs", type=int, default=5)
    p.add_argument("--size", default="256x256")
    p.add_argument("--spp", type=int, default=64)
    p.add_argument("--out", default="out/ranks")
    return p.parse_intermixed_args()


def render(o, scene, ranks, balance, out, map_file=None):
    report = out / "report.json"
    command = [o.program, "render", scene, "--quiet", "--size", o.size, "--spp", str(o.spp), "--threads", "1",
               "--balance", balance, "-o", str(out / "picture.exr"), "--report", str(report)]
    if map_file:
        command += ["--balance-map", str(map_file)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] + command
    env = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(command, env=env, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr}")
    return json.loads(report.read_text())


def simulated(o, map_file, ranks):
    done = subprocess.run([o.simulator, str(map_file), "--spp", str(o.spp), "--ranks", str(ranks)],
                          capture_output=True, text=True, check=True)
    rows = [line.split(",") for line in done.stdout.splitlines()[1:]]
    return {row[0]: {"speedup": float(row[4]), "imbalance": float(row[6])} for row in rows}


def cpu_imbalance(ranks):
    """What matters for fixed regions on a machine that others use, too. Leases follow the wall clock instead."""
    cpu = [r["cpu_s"] for r in ranks]
    return max(cpu) * len(cpu) / sum(cpu)


def bench(o, scene, out):
    map_file = out / (pathlib.Path(scene).stem + "-map.exr")
    render(o, scene, 1, "dynamic", out, map_file)  # warms up, and measures the costs
    turns = []
    for _ in range(o.runs):
        turn = {"one": render(o, scene, 1, "dynamic", out)["wall_s"]}
        for s in STRATEGIES:
            report = render(o, scene, o.ranks, s, out)
            turn[s] = {"wall_s": report["wall_s"], "imbalance": report["imbalance"], "per_rank": report["per_rank"]}
        turns.append(turn)
    guess = simulated(o, map_file, o.ranks)
    rows = []
    for s in STRATEGIES:
        ratios = sorted(t["one"] / t[s]["wall_s"] for t in turns)
        uneven = statistics.median(t[s]["imbalance"] for t in turns)
        cpu = statistics.median(cpu_imbalance(t[s]["per_rank"]) for t in turns)
        rows.append({"scene": pathlib.Path(scene).stem, "strategy": s, "speedup": statistics.median(ratios),
                     "lowest": ratios[0], "highest": ratios[-1], "imbalance": uneven, "cpu_imbalance": cpu,
                     "simulated_speedup": guess[s]["speedup"], "simulated_imbalance": guess[s]["imbalance"]})
        r = rows[-1]
        print(f"{r['scene']:18} {s:8} {r['speedup']:7.3f} [{r['lowest']:.3f}, {r['highest']:.3f}] "
              f"{uneven:9.3f} {cpu:7.3f}   simulated {r['simulated_speedup']:.3f} {r['simulated_imbalance']:.3f}", flush=True)
    return rows, turns


def main():
    o = parse()
    out = pathlib.Path(o.out)
    out.mkdir(parents=True, exist_ok=True)
    scenes = o.scenes or [str(ROOT / s["file"]) for s in json.loads((ROOT / "bench/scenes.json").read_text())]
    print(f"{'scene':18} strategy  speed-up [range] of {o.ranks} ranks   imbalance: wall, cpu")
    results = []
    for scene in scenes:
        rows, turns = bench(o, scene, out)
        results.append({"scene": scene, "rows": rows, "turns": turns})
        (out / "ranks.json").write_text(json.dumps(
            {"ranks": o.ranks, "runs": o.runs, "size": o.size, "spp": o.spp, "results": results}, indent=1))


if __name__ == "__main__":
    main()
