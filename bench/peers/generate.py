"""Meshes by formula: the same surfaces as src/scene/generate_*.cpp, the vertices in another order."""
import math
from dataclasses import dataclass

import numpy as np



@dataclass
class Mesh:
    positions: np.ndarray           # [num_vertices, 3]
    indices: np.ndarray             # [num_triangles, 3]
    normals: np.ndarray = None      # [num_vertices, 3], unit
    uvs: np.ndarray = None          # [num_vertices, 2]
    colours: np.ndarray = None      # [num_vertices, 3], linear RGB


def box(lo, hi):
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
    lo, hi = np.array(lo, dtype=float), np.array(hi, dtype=float)
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    indices = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
    return Mesh(lo + corners * (hi - lo), np.array(indices))


def icosphere(radius, subdivisions):
    g = (1 + math.sqrt(5)) / 2
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
               (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    directions = [np.array(c) / np.linalg.norm(c) for c in corners]
    for _ in range(subdivisions):
        middles, split = {}, []

        def middle(a, b):
            edge = (min(a, b), max(a, b))
            if edge not in middles:
                middles[edge] = len(directions)
                sum_ = directions[a] + directions[b]
                directions.append(sum_ / np.linalg.norm(sum_))
            return middles[edge]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            split += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = split
    directions = np.array(directions)
    return Mesh(radius * directions, np.array(faces), directions)


def torus_knot(p, q, radius, tube_radius, segments, sides):
    divisor = math.gcd(p, q)
    p, q = p // divisor, q // divisor
    t = 2 * math.pi * np.arange(segments)[:, None] / segments
    ca, sa, cw, sw = np.cos(p * t), np.sin(p * t), np.cos(q * t), np.sin(q * t)
    minor = radius / 2
    distance = radius + minor * cw
    tangent = np.hstack([-p * distance * sa - q * minor * sw * ca,
                         p * distance * ca - q * minor * sw * sa, q * minor * cw])
    point = np.hstack([distance * ca, distance * sa, minor * sw])
    normal = np.hstack([cw * ca, cw * sa, sw])
    binormal = np.cross(normal, tangent)
    binormal /= np.linalg.norm(tangent, axis=1, keepdims=True)
    side = 2 * math.pi * np.arange(sides) / sides
    across = (np.cos(side)[None, :, None] * normal[:, None] +
              np.sin(side)[None, :, None] * binormal[:, None])
    i, j = np.meshgrid(np.arange(segments), np.arange(sides), indexing="ij")
    ring, following, k = i * sides, (i + 1) % segments * sides, (j + 1) % sides
    a, b, c, d = ring + j, following + j, following + k, ring + k
    indices = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], -2).reshape(-1, 3)
    return Mesh((point[:, None] + tube_radius * across).reshape(-1, 3), indices,
                across.reshape(-1, 3))


def sphere_flake(radius, level, ratio):
    """Rows of x, y, z, radius."""
    h, up, out = math.sqrt(3) / 2, math.sqrt(2 / 3), math.sqrt(1 / 3)
    directions = np.array([[1, 0, 0], [.5, h, 0], [-.5, h, 0], [-1, 0, 0], [-.5, -h, 0],
                           [.5, -h, 0], [out * h, out * .5, up], [-out * h, out * .5, up],
                           [0, -out, up]])
    generation = [(np.zeros(3), np.eye(3), radius)]
    spheres = []
    for i in range(level + 1):
        spheres += [(*center, r) for center, _, r in generation]
        generation = [flake_child(s, d, ratio) for s in generation for d in directions]
        if i == level:
            return np.array(spheres)


def flake_child(parent, direction, ratio):
    """The axes are columns; the third points away from the parent, the first is the parent's axis
    least along the child's direction, made perpendicular."""
    center, axes, radius = parent
    up = axes @ direction
    up /= np.linalg.norm(up)
    old = axes[:, np.argmin(np.abs(direction))]
    x = old - (old @ up) * up
    x /= np.linalg.norm(x)
    child_axes = np.column_stack([x, np.cross(up, x), up])
    return center + up * (radius + radius * ratio), child_axes, radius * ratio


