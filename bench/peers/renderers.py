"""The two renderers: pictures of one scene with different seeds."""
import json
import os
import subprocess
import time

import numpy as np

from export import export_scene


class Failed(Exception):
    """A renderer stopped; holds its message."""


def comparable(scene, size, scene_folder):
    """The scene as both render it: one-pixel box filter, no roulette, this size, absolute file names."""
    scene = json.loads(json.dumps(scene))
    film = scene.setdefault("film", {})
    film |= {"filter": {"type": "box", "radius": 0.5}, "width": size[0], "height": size[1]}
    integrator = scene.setdefault("integrator", {})
    integrator["roulette_depth"] = integrator.setdefault("max_depth", 16)
    make_absolute(scene, scene_folder)
    return scene


def make_absolute(node, folder):
    for value in node.values() if isinstance(node, dict) else node:
        if isinstance(value, (dict, list)):
            make_absolute(value, folder)
    if isinstance(node, dict) and isinstance(node.get("file"), str):
        node["file"] = os.path.join(folder, node["file"])


def read_picture(path):
    import mitsuba as mi
    bitmap = mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    return np.array(bitmap)


def phalanx_pictures(program, scene, folder, options):
    """[runs, height, width, 3], and seconds."""
    scene_file, picture = (os.path.join(folder, name) for name in ("scene.json", "run.exr"))
    with open(scene_file, "w") as file:
        json.dump(scene, file)
    pictures, start = [], time.perf_counter()
    for run in range(options.runs):
        done = subprocess.run(
            [program, "render", scene_file, "-o", picture, "--quiet", "--strict", "--spp",
             str(options.spp), "--seed", str(options.seed + run), "--threads", str(options.threads)],
            capture_output=True, text=True)
        if done.returncode != 0:
            raise Failed(done.stderr.strip() or f"{program} ended with {done.returncode}")
        pictures.append(read_picture(picture))
    return np.array(pictures), time.perf_counter() - start


def mitsuba_pictures(scene, folder, options):
    """[runs, height, width, 3], and seconds."""
    import mitsuba as mi
    loaded = mi.load_dict(export_scene(scene, folder, folder, options.plain))
    start = time.perf_counter()
    pictures = [np.array(mi.render(loaded, spp=options.spp, seed=options.seed + 7919 + run))
                for run in range(options.runs)]
    return np.array(pictures), time.perf_counter() - start
