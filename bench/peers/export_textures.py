"""Parameters that are constants or textures.

Images are decoded here, tinted, reduced to a channel where a number is wanted, and written as EXR with
the rows turned over: v = 0 is the lower edge of our images and the upper edge of Mitsuba's.
"""
import os

import mitsuba as mi
import numpy as np

from scene_keys import Unsupported, as_colour

WRAP_MODES = {"repeat": "repeat", "clamp": "clamp", "mirrored": "mirror"}
CHANNELS = {"r": 0, "g": 1, "b": 2, "a": 3}
SRGB_FILES = (".png", ".jpg", ".jpeg")
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def rgb(colour):
    return {"type": "rgb", "value": [float(c) for c in colour]}


def to_uv(keys, before=np.eye(3)):
    """The texture's "transform" (scale, then turn, then move), then `before`."""
    transform = keys.object("transform")
    angle = np.radians(transform.get("rotate", 0))
    m = np.diag([*np.broadcast_to(transform.vector("scale", 1), (2,)), 1.0])
    m = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0],
                  [0, 0, 1]]) @ m
    m[:2, 2] = transform.vector("offset", [0, 0])
    transform.finish()
    return mi.ScalarTransform3f(before @ m)


def read_image(path, srgb):
    """[height, width, 4], linear."""
    bitmap = mi.Bitmap(path)
    bitmap.set_srgb_gamma(srgb)
    pixels = np.array(bitmap.convert(mi.Bitmap.PixelFormat.RGBA, mi.Struct.Type.Float32, False))
    return pixels.astype(np.float64)


class Textures:
    """The scene's textures by name; images go to `folder`."""

    def __init__(self, all_keys, folder, scene_folder):
        self.folder, self.scene_folder, self.num_images = folder, scene_folder, 0
        self.by_name = {keys.get("name"): keys for keys in all_keys}

    def colour(self, keys, key, default, scale=1.0):
        """A constant or a texture, times a number or colour."""
        value = keys.get(key, default)
        if not isinstance(value, str):
            return rgb(as_colour(value, f"{keys.path}/{key}") * scale)
        return self._texture(value, scale, as_number=False)

    def number(self, keys, key, default):
        value = keys.get(key, default)
        if isinstance(value, str):
            return self._texture(value, 1.0, as_number=True)
        return float(value)

    def raw(self, name):
        """A texture whose colours are no colours: a normal map."""
        return self._texture(name, 1.0, as_number=False)

    def _texture(self, name, scale, as_number):
        keys = self.by_name.get(name)
        if keys is None:
            raise Unsupported(f"unknown texture '{name}'")
        kind = keys.get("type")
        if kind not in KINDS:
            keys.refuse("type", f"'{kind}' has no twin in Mitsuba")
        plugin = KINDS[kind](self, keys, scale, as_number)
        keys.finish()
        return plugin

    def write(self, pixels):
        path = os.path.join(self.folder, f"image-{self.num_images}.exr")
        self.num_images += 1
        mi.Bitmap(np.ascontiguousarray(pixels, dtype=np.float32)).write(path)
        return path


def constant(textures, keys, scale, as_number):
    colour = keys.colour("colour") * scale
    return float(colour @ LUMINANCE) if as_number else rgb(colour)


def image(textures, keys, scale, as_number):
    file = keys.get("file")
    by_default = "srgb" if file.lower().endswith(SRGB_FILES) else "linear"
    pixels = read_image(os.path.join(textures.scene_folder, file),
                        keys.get("colour_space", by_default) == "srgb")
    pixels[..., :3] *= keys.colour("tint", 1) * scale
    channel = keys.get("channel", "luminance")
    if not as_number:
        pixels = pixels[..., :3]
    elif channel == "luminance":
        pixels = pixels[..., :3] @ LUMINANCE[:, None]
    else:
        pixels = pixels[..., CHANNELS[channel], None]
    wrap = keys.get("wrap", "repeat")
    if {keys.get("wrap_u", wrap), keys.get("wrap_v", wrap)} != {wrap}:
        keys.refuse("wrap_u", "Mitsuba wraps both axes in the same way")
    return {"type": "bitmap", "filename": textures.write(np.flipud(pixels)), "raw": True,
            "filter_type": keys.get("filter", "bilinear"), "wrap_mode": WRAP_MODES[wrap],
            "to_uv": to_uv(keys)}


def checker(textures, keys, scale, as_number):
    """Mitsuba's pattern has two squares a unit, ours one. Read as a number it has its colours
    exchanged (checkerboard.cpp, eval_1)."""
    if "scale" in keys:
        keys.refuse("scale", "cubes in space have no twin in Mitsuba")
    a, b = keys.colour("a", 1) * scale, keys.colour("b", 0) * scale
    if as_number:
        a, b = b, a
    half = np.diag([0.5, 0.5, 1.0])
    return {"type": "checkerboard", "color0": rgb(a), "color1": rgb(b), "to_uv": to_uv(keys, half)}


def vertex_colour(textures, keys, scale, as_number):
    if np.any(keys.colour("tint", 1) * scale != 1):
        keys.refuse("tint", "Mitsuba's attributes take no tint")
    if as_number:
        keys.refuse("type", "vertex colours as a number are not exported")
    return {"type": "mesh_attribute", "name": "vertex_color"}


KINDS = {f.__name__: f for f in (constant, image, checker, vertex_colour)}
