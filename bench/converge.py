#!/usr/bin/env python3
"""Turn the JSON of `phalanx converge` into one HTML page with pictures: error against seconds.

Usage: bench/converge.py FILE.json PAGE.html [FOLDER]      FOLDER: what --maps wrote
The page holds everything it shows; nothing is loaded from elsewhere. Needs Python alone.
"""
import base64
import html
import json
import math
import os
import sys

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555"]
WIDTH, HEIGHT = 560, 380
LEFT, RIGHT, TOP, BOTTOM = 64, 12, 12, 44


def name_of(curve):
    return f"{curve['mode']}, {curve['sampler']}"


def stem_of(scene):
    return os.path.splitext(os.path.basename(scene["scene"]))[0]


def usable(curve):
    return [p for p in curve["points"] if p["relmse"] and p["relmse"] > 0 and p["wall_s"] > 0]


class Axes:
    """Logarithmic axes around some points, in SVG coordinates."""

    def __init__(self, points):
        xs = [p["wall_s"] for p in points]
        ys = [v for p in points for v in (p["relmse"], p["lo95"], p["hi95"]) if v and v > 0]
        self.x0, self.x1 = math.log10(min(xs)) - 0.08, math.log10(max(xs)) + 0.08
        self.y0, self.y1 = math.log10(min(ys)) - 0.1, math.log10(max(ys)) + 0.1

    def x(self, seconds):
        return LEFT + (math.log10(seconds) - self.x0) / (self.x1 - self.x0) * (WIDTH - LEFT - RIGHT)

    def y(self, error):
        at = min(max(math.log10(error), self.y0), self.y1)
        return HEIGHT - BOTTOM - (at - self.y0) / (self.y1 - self.y0) * (HEIGHT - TOP - BOTTOM)

    @staticmethod
    def ticks(lo, hi):
        steps = (1, 2, 5) if hi - lo < 2.5 else (1,)
        for k in range(math.floor(lo), math.ceil(hi) + 1):
            for s in steps:
                if lo <= k + math.log10(s) <= hi:
                    yield s * 10.0 ** k

    def svg(self):
        out = [f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" '
               f'height="{HEIGHT - TOP - BOTTOM}" fill="none" stroke="#999"/>']
        for t in self.ticks(self.x0, self.x1):
            out.append(f'<line x1="{self.x(t):.1f}" x2="{self.x(t):.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" '
                       f'stroke="#ddd"/><text x="{self.x(t):.1f}" y="{HEIGHT - BOTTOM + 16}" '
                       f'text-anchor="middle">{t:g}</text>')
        for t in self.ticks(self.y0, self.y1):
            out.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{self.y(t):.1f}" y2="{self.y(t):.1f}" '
                       f'stroke="#ddd"/><text x="{LEFT - 6}" y="{self.y(t) + 4:.1f}" '
                       f'text-anchor="end">{t:.0e}</text>')
        out.append(f'<text x="{(LEFT + WIDTH) / 2:.0f}" y="{HEIGHT - 8}" text-anchor="middle">seconds of '
                   'rendering</text>')
        out.append(f'<text transform="translate(14 {HEIGHT / 2:.0f}) rotate(-90)" '
                   'text-anchor="middle">relMSE</text>')
        return "".join(out)


def guide(axes, points):
    """A dashed line of slope -1 through the first point of all."""
    first = min(points, key=lambda p: p["wall_s"])
    t0, e0 = first["wall_s"], first["relmse"]
    t1 = min(10 ** axes.x1, t0 * e0 / 10 ** axes.y0)
    return (f'<line x1="{axes.x(t0):.1f}" y1="{axes.y(e0):.1f}" x2="{axes.x(t1):.1f}" '
            f'y2="{axes.y(e0 * t0 / t1):.1f}" stroke="#888" stroke-dasharray="5 4"/>')


def plot(scene):
    all_points = [p for c in scene["curves"] for p in usable(c)]
    if not all_points:
        return "<p>No error above the noise of the reference.</p>"
    axes = Axes(all_points)
    out = [f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img">', axes.svg(), guide(axes, all_points)]
    for i, curve in enumerate(scene["curves"]):
        colour, points = COLOURS[i % len(COLOURS)], usable(curve)
        if not points:
            continue
        band = [(p["wall_s"], p["hi95"] or p["relmse"]) for p in points]
        band += [(p["wall_s"], p["lo95"] or p["relmse"]) for p in reversed(points)]
        path = " ".join(f"{axes.x(t):.1f},{axes.y(e):.1f}" for t, e in band)
        line = " ".join(f'{axes.x(p["wall_s"]):.1f},{axes.y(p["relmse"]):.1f}' for p in points)
        out.append(f'<polygon points="{path}" fill="{colour}" fill-opacity="0.18"/>'
                   f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        for p in points:
            out.append(f'<circle cx="{axes.x(p["wall_s"]):.1f}" cy="{axes.y(p["relmse"]):.1f}" r="3" '
                       f'fill="{colour}"><title>{p["spp"]} spp: {p["relmse"]:.3g} after '
                       f'{p["wall_s"]:.3g} s</title></circle>')
        out.append(f'<text x="{WIDTH - RIGHT - 8}" y="{TOP + 18 + 16 * i}" text-anchor="end" '
                   f'fill="{colour}">{html.escape(name_of(curve))}</text>')
    return "".join(out) + "</svg>"


def number(x, digits=3):
    return "–" if x is None else f"{x:.{digits}g}"


def interval(i):
    if i is None or i["value"] is None:
        return "–"
    if i["lo95"] is None:
        return number(i["value"])
    return f'{number(i["value"])} <small>[{number(i["lo95"])}, {number(i["hi95"])}]</small>'


def table(head, rows):
    cells = "".join(f"<th>{h}</th>" for h in head)
    body = "".join("<tr>" + "".join(f"<td>{c}</td>" for c in row) + "</tr>" for row in rows)
    return f"<table><tr>{cells}</tr>{body}</table>"


def scene_table(scene):
    targets = [t["relmse"] for t in scene["curves"][0]["seconds_to"]]
    head = ["contestant", "spp", "seconds", "relMSE", "slope"]
    head += [f"s to {t:.0e}" for t in targets] + ["speed-up", "bias² / MSE, upper bound"]
    rows = []
    for curve in scene["curves"]:
        last = curve["points"][-1]
        bias = curve["squared_bias"]["hi95"]
        rows.append([html.escape(name_of(curve)), last["spp"], number(last["wall_s"]),
                     interval({"value": last["relmse"], "lo95": last["lo95"], "hi95": last["hi95"]}),
                     interval(curve["slope"])]
                    + [interval(t) for t in curve["seconds_to"]]
                    + [interval(curve.get("versus_first", {}).get("speed_up")) if "versus_first" in curve
                       else "1", "–" if bias is None or not last["relmse"] else f'{100 * bias / last["relmse"]:.2g} %'])
    return table(head, rows)


def maps(scene, folder):
    out = []
    for curve in scene["curves"]:
        path = os.path.join(folder, f"{stem_of(scene)}-{curve['mode']}-{curve['sampler']}.png")
        if not os.path.exists(path):
            continue
        with open(path, "rb") as file:
            data = base64.b64encode(file.read()).decode()
        out.append(f'<figure><img src="data:image/png;base64,{data}" alt="error map"><figcaption>'
                   f"{html.escape(name_of(curve))}</figcaption></figure>")
    return '<div class="maps">' + "".join(out) + "</div>"


def mean_of_logs(values):
    values = [v for v in values if v and v > 0]
    return math.exp(sum(map(math.log, values)) / len(values)) if values else None


def overall(scenes):
    rows = []
    for i, curve in enumerate(scenes[0]["curves"]):
        same = [s["curves"][i] for s in scenes if i < len(s["curves"])]
        speed = mean_of_logs([c["versus_first"]["speed_up"]["value"] for c in same if "versus_first" in c])
        ratio = mean_of_logs([c["versus_first"]["relmse_ratio"]["value"] for c in same if "versus_first" in c])
        rows.append([html.escape(name_of(curve)), "1" if i == 0 else number(speed), "1" if i == 0 else number(ratio),
                     number(mean_of_logs([c["points"][-1]["efficiency"] for c in same]))])
    return table(["contestant", "speed-up to equal error", "relMSE after equal time", "1 / (relMSE · s)"], rows)


STYLE = """body{font:15px/1.45 system-ui,sans-serif;max-width:1180px;margin:2em auto;padding:0 1em;color:#222}
h2{margin-top:2em;border-top:1px solid #ccc;padding-top:.8em}
table{border-collapse:collapse;margin:.8em 0;font-size:13px;display:block;overflow-x:auto}
td,th{padding:.25em .7em;border-bottom:1px solid #ddd;text-align:right;white-space:nowrap}
td:first-child,th:first-child{text-align:left}
svg{width:100%;max-width:640px;font-size:12px}small{color:#666}
.maps{display:flex;flex-wrap:wrap;gap:12px}figure{margin:0}img{width:180px;image-rendering:pixelated}
figcaption{font-size:12px}"""

NOTE = """<p>Means over runs with seeds of their own; bands are 95 % intervals. Errors are against two independent halves of a
reference, so that the reference's own noise is not in them. Seconds are medians, without setting up the scene. The dashed
line has slope −1. Speed-up: seconds of the first contestant / seconds, to the smallest error that both reach. Error maps:
black 1 % and less, light yellow 100 % and more, of the pixel. docs/error.md explains every figure.</p>"""


def page(data, folder):
    scenes = data["scenes"]
    parts = [f"<!doctype html><html lang=en><meta charset=utf-8><title>Error against run time</title><style>{STYLE}</style>",
             "<h1>Error against run time</h1>", NOTE]
    if len(scenes) > 1:
        parts += [f"<h2>All {len(scenes)} scenes, geometric means</h2>", overall(scenes)]
    for scene in scenes:
        runs = len(scene["curves"][0]["runs"])
        parts += [f"<h2>{html.escape(stem_of(scene))}</h2>",
                  f'<p>{scene["width"]} × {scene["height"]}, depth {scene["max_depth"]}, {scene["isa"]}, '
                  f'{scene["threads"]} thread(s), {runs} seeds, set-up {scene["setup_s"]:.3g} s; '
                  f'reference: {html.escape(scene["reference"])}</p>',
                  plot(scene), scene_table(scene), maps(scene, folder) if folder else ""]
    return "\n".join(parts) + "</html>\n"


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[1] in ("-h", "--help"):
        sys.exit(__doc__)
    with open(sys.argv[1]) as file:
        data = json.load(file)
    text = page(data, sys.argv[3] if len(sys.argv) == 4 else "")
    with open(sys.argv[2], "w") as file:
        file.write(text)


if __name__ == "__main__":
    main()
