#!/usr/bin/env python3
"""Write the small pictures that the scenes use: letters.png, waves.png, surroundings.hdr."""
import os

import mitsuba as mi
import numpy as np

LETTERS = ["................", ".####...####....", ".#...#.#....#...", ".####..#........",
           ".#...#.#..###...", ".#...#.#....#...", ".####...####....", "................",
           "..R.....G....B..", "..RR....GG...BB.", "..R.....G....B..", "................",
           "................", "################", "................", "################"]
COLOURS = {".": (230, 225, 215), "#": (40, 60, 120), "R": (220, 30, 30), "G": (30, 180, 60),
           "B": (250, 200, 20)}


def letters():
    """No symmetry: a texture that is turned over or wraps the wrong way shows."""
    return np.array([[COLOURS[c] for c in row] for row in LETTERS], dtype=np.uint8)


def waves():
    """Normals of gentle waves, (n + 1) / 2; one period each way, other slopes along u than along v."""
    n = 32
    u = 2 * np.pi * (np.arange(n) + 0.5)[None, :] / n
    v = 2 * np.pi * (n - np.arange(n) - 0.5)[:, None] / n
    normal = np.stack([-0.3 * np.cos(u) + 0 * v, -0.15 * np.cos(2 * v + u), np.ones((n, n))], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    return np.round((normal + 1) / 2 * 255).astype(np.uint8)


def surroundings():
    """Blue above, brown below, a window and a small bright lamp."""
    height, width = 16, 32
    v = ((np.arange(height) + 0.5) / height)[:, None, None]
    u = ((np.arange(width) + 0.5) / width)[None, :, None]
    sky = np.array([0.3, 0.5, 0.9]) * (1 - v) + np.array([0.5, 0.35, 0.2]) * v
    sky = sky * (1 + 0.3 * np.cos(2 * np.pi * u))
    sky[4:8, 20:26] += [3, 2.8, 2.2]
    sky[3, 8] += [60, 50, 30]
    return sky.astype(np.float32)


def main():
    mi.set_variant("scalar_rgb")
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes")
    mi.Bitmap(letters()).write(os.path.join(folder, "letters.png"))
    mi.Bitmap(waves()).write(os.path.join(folder, "waves.png"))
    mi.Bitmap(surroundings()).write(os.path.join(folder, "surroundings.hdr"))


if __name__ == "__main__":
    main()
