"""Shapes: rectangles, disks and spheres stay what they are, everything else becomes a PLY file."""
import os

import mitsuba as mi
import numpy as np

import generate
import transforms as tf
from generate import Mesh
from ply import write_ply
from scene_keys import Unsupported

BACK_OFFSET = 1e-5  # of the size: where the back of what shines on both sides stands


class Shapes:
    """Turns shapes into plugins' descriptions; meshes go to `folder`."""

    def __init__(self, materials, folder, scene_folder):
        self.materials, self.folder, self.scene_folder = materials, folder, scene_folder
        self.num_files = 0

    def plugins(self, keys, placed=np.eye(4)):
        """The shape under its own transform and then `placed`."""
        kind, name = keys.get("type"), keys.get("material")
        if name not in self.materials.bsdf:
            raise Unsupported(f"{keys.path}/material: unknown material '{name}'")
        m = placed @ tf.transform_of(keys)
        if self.materials.needs_uv[name] and kind not in ("quad", "disk") and "uvs" not in keys:
            raise Unsupported(f"{keys.path}: textures are exported on quads, disks and inline meshes "
                              "with uvs only")
        if kind not in BUILDERS:
            raise Unsupported(f"{keys.path}/type: '{kind}' is not exported")
        plugins = BUILDERS[kind](self, keys, m)
        keys.finish()
        radiance = self.materials.radiance[name]
        if radiance is not None and self.materials.emits_on_both_sides[name]:
            if any("to_world" not in p or p["type"] == "sphere" for p in plugins):
                raise Unsupported(f"{keys.path}: only rectangles and disks may shine on both sides")
            plugins += [turned_over(p) for p in plugins]
        for plugin in plugins:
            plugin["bsdf"] = {"type": "ref", "id": bsdf_id(name)}
            if radiance is not None:
                plugin["emitter"] = {"type": "area", "radiance": radiance}
        return plugins

    def new_file(self, kind, extension):
        self.num_files += 1
        return os.path.join(self.folder, f"{kind}-{self.num_files}.{extension}")

    def emits(self, keys):
        return self.materials.radiance.get(keys.value.get("material")) is not None

    def mesh(self, mesh, m):
        """A PLY file in world space."""
        path = self.new_file("mesh", "ply")
        normals = None if mesh.normals is None else tf.normals(m, mesh.normals)
        indices = mesh.indices[:, ::-1] if tf.mirrors(m) else mesh.indices
        write_ply(path, Mesh(tf.points(m, mesh.positions), indices, normals, mesh.uvs,
                             mesh.colours))
        return [{"type": "ply", "filename": path, "face_normals": normals is None}]


def bsdf_id(name):
    return "material-" + name


def to_world(columns, origin):
    m = np.eye(4)
    m[:3, :3], m[:3, 3] = columns, origin
    return mi.ScalarTransform4f(m)


def turned_over(plugin):
    """The other side of a flat shape, a hair behind it."""
    m = np.array(plugin["to_world"].matrix, dtype=float)
    size = np.linalg.norm(m[:3, 0])
    normal = m[:3, 2] / np.linalg.norm(m[:3, 2])
    columns = m[:3, :3] @ np.diag([-1.0, 1.0, -1.0])
    return {"type": plugin["type"], "to_world": to_world(columns, m[:3, 3] - BACK_OFFSET * size * normal)}


def quad(shapes, keys, m):
    corner = tf.points(m, keys.vector("corner"))
    u, v = tf.vectors(m, keys.vector("edge_u")), tf.vectors(m, keys.vector("edge_v"))
    if tf.mirrors(m):
        u, v = v, u
    if abs(u @ v) > 1e-6 * np.linalg.norm(u) * np.linalg.norm(v):
        uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
        indices = np.array([[0, 1, 2], [0, 2, 3]])
        return shapes.mesh(Mesh(corner + uvs @ np.array([u, v]), indices, uvs=uvs), np.eye(4))
    n = np.cross(u, v)
    columns = np.column_stack([u / 2, v / 2, n / np.linalg.norm(n)])
    return [{"type": "rectangle", "to_world": to_world(columns, corner + u / 2 + v / 2)}]


def sphere(shapes, keys, m):
    scale = tf.similarity_scale(m, keys.path)
    return [sphere_plugin(tf.points(m, keys.vector("center")), keys.get("radius") * scale)]


def sphere_plugin(center, radius):
    return {"type": "sphere", "center": [float(x) for x in center], "radius": float(radius)}


def disk(shapes, keys, m):
    scale = tf.similarity_scale(m, keys.path)
    axes = tf.frame(tf.normals(m, keys.vector("normal"))) * (keys.get("radius") * scale)
    return [{"type": "disk", "to_world": to_world(axes, tf.points(m, keys.vector("center")))}]


def mesh(shapes, keys, m):
    if "file" in keys:
        return mesh_file(shapes, keys, m)
    sizes = {"positions": 3, "normals": 3, "uvs": 2, "colours": 3}
    arrays = {key: keys.vector(key, None) for key in sizes}
    arrays = {key: None if a is None else a.reshape(-1, sizes[key]) for key, a in arrays.items()}
    indices = np.array(keys.get("indices"), dtype=int).reshape(-1, 3)
    return shapes.mesh(Mesh(indices=indices, **arrays), m)


def mesh_file(shapes, keys, m):
    """Mitsuba's own readers. They would smooth a mesh without normals."""
    path = os.path.join(shapes.scene_folder, keys.get("file"))
    kind = os.path.splitext(path)[1][1:].lower()
    if kind not in ("obj", "ply"):
        keys.refuse("file", "only .obj and .ply are exported")
    if tf.mirrors(m):
        keys.refuse("transform", "mirrored mesh files are not exported")
    return [{"type": kind, "filename": os.path.abspath(path), "face_normals": not has_normals(path),
             "to_world": mi.ScalarTransform4f(m)}]


def has_normals(path):
    with open(path, "rb") as file:
        if path.lower().endswith(".obj"):
            return any(line.startswith(b"vn ") for line in file)
        for line in file:
            if line.split()[-1:] == [b"nx"]:
                return True
            if line.startswith(b"end_header"):
                return False
    return False


def box(shapes, keys, m):
    return shapes.mesh(generate.box(keys.vector("lo", [-1, -1, -1]), keys.vector("hi", [1, 1, 1])), m)


def icosphere(shapes, keys, m):
    return shapes.mesh(generate.icosphere(keys.get("radius", 1), keys.get("subdivisions", 4)), m)


def torus_knot(shapes, keys, m):
    arguments = {"p": 2, "q": 3, "radius": 1, "tube_radius": 0.25, "segments": 512, "sides": 32}
    arguments = {key: keys.get(key, default) for key, default in arguments.items()}
    return shapes.mesh(generate.torus_knot(**arguments), m)


def sphere_flake(shapes, keys, m):
    spheres = generate.sphere_flake(keys.get("radius", 1), keys.get("level", 3),
                                    keys.get("ratio", 1 / 3))
    scale = tf.similarity_scale(m, keys.path)
    return [sphere_plugin(tf.points(m, s[:3]), s[3] * scale) for s in spheres]


def curves(shapes, keys, m):
    """Straight pieces of hair: a text file of x, y, z, radius, strands parted by empty lines."""
    if keys.get("basis", "linear") != "linear":
        keys.refuse("basis", "only linear curves are exported")
    scale = tf.similarity_scale(m, keys.path)
    radii = np.broadcast_to(keys.vector("radius"), (2,)) * scale
    path = shapes.new_file("curves", "txt")
    with open(path, "w") as file:
        for strand in keys.get("strands"):
            radius = np.linspace(*radii, len(strand))[:, None]
            np.savetxt(file, np.hstack([tf.points(m, strand), radius]), fmt="%.9g")
            file.write("\n")
    return [{"type": "linearcurve", "filename": path}]


BUILDERS = {f.__name__: f for f in
            (quad, sphere, disk, mesh, box, icosphere, torus_knot, sphere_flake, curves)}
