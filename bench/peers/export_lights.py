"""Lights that are no surfaces."""
import os

import mitsuba as mi
import numpy as np

from export_textures import read_image, rgb


def environment(keys, folder, scene_folder):
    if "file" in keys:
        return environment_map(keys, folder, scene_folder)
    return {"type": "constant", "radiance": rgb(keys.colour("radiance"))}


def environment_map(keys, folder, scene_folder):
    """The same bilinear function on a finer grid. Our rows are samples at the middles of texels,
    Mitsuba's first and last row are the poles: with twice the rows and one more, every second row of
    Mitsuba's is one of ours and the others are means. Columns agree, but ours start half a turn on."""
    pixels = read_image(os.path.join(scene_folder, keys.get("file")), srgb=False)[..., :3]
    pixels = pixels * keys.colour("scale", 1)
    padded = np.concatenate([pixels[:1], pixels, pixels[-1:]])
    fine = np.empty((2 * len(pixels) + 1, *pixels.shape[1:]), dtype=np.float32)
    fine[1::2], fine[0::2] = pixels, (padded[:-1] + padded[1:]) / 2
    path = os.path.join(folder, "environment.exr")
    mi.Bitmap(fine).write(path)
    angle = np.radians(keys.get("rotate", 0))
    c, s = np.cos(angle), np.sin(angle)
    axes = np.eye(4)
    axes[:3, :3] = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ np.diag([-1, 1, -1])
    return {"type": "envmap", "filename": path, "to_world": mi.ScalarTransform4f(axes)}


def point(keys, folder, scene_folder):
    return {"type": "point", "position": keys.vector("position").tolist(),
            "intensity": rgb(keys.colour("intensity"))}


def spot(keys, folder, scene_folder):
    """Mitsuba's fades linearly in the angle, ours by the smoothstep of the cosine."""
    angle = keys.get("outer_angle", 45)
    if keys.get("inner_angle", 40) != angle:
        keys.refuse("inner_angle", "only spots with a hard edge, inner_angle = outer_angle")
    position, direction = keys.vector("position"), keys.vector("direction")
    up = np.eye(3)[np.argmin(np.abs(direction))]
    return {"type": "spot", "intensity": rgb(keys.colour("intensity")), "cutoff_angle": angle,
            "beam_width": angle * (1 - 1e-5),
            "to_world": mi.ScalarTransform4f().look_at(position.tolist(),
                                                       (position + direction).tolist(), up.tolist())}


def directional(keys, folder, scene_folder):
    return {"type": "directional", "direction": keys.vector("direction").tolist(),
            "irradiance": rgb(keys.colour("irradiance"))}


KINDS = {f.__name__: f for f in (environment, point, spot, directional)}


def light_plugin(keys, folder, scene_folder):
    kind = keys.get("type")
    if kind not in KINDS:
        keys.refuse("type", f"'{kind}' has no twin in Mitsuba")
    plugin = KINDS[kind](keys, folder, scene_folder)
    keys.finish()
    return plugin
