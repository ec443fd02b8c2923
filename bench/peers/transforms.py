"""The scene file's transforms as 4 x 4 matrices for column vectors."""
import numpy as np

from scene_keys import Unsupported


def translation(offset):
    m = np.eye(4)
    m[:3, 3] = offset
    return m


def scaling(factors):
    return np.diag([*np.broadcast_to(np.array(factors, dtype=float), (3,)), 1.0])


def rotation(axis, degrees):
    """Right-handed, Rodrigues' formula."""
    x, y, z = np.array(axis, dtype=float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    m = np.eye(4)
    m[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return m


def step_matrix(step, path):
    if len(step) != 1:
        raise Unsupported(f"{path}: expected one of translate, rotate, scale, matrix")
    (kind, value), = step.items()
    if kind == "translate":
        return translation(value)
    if kind == "scale":
        return scaling(value)
    if kind == "rotate":
        return rotation(value["axis"], value["angle"])
    if kind == "matrix":
        return np.array(value, dtype=float).reshape(4, 4)
    raise Unsupported(f"{path}/{kind}: not exported")


def transform_of(keys):
    """Matrix of the object's "transform": one step, or steps applied in their order."""
    steps = keys.get("transform", [])
    m = np.eye(4)
    for step in steps if isinstance(steps, list) else [steps]:
        m = step_matrix(step, f"{keys.path}/transform") @ m
    return m


def mirrors(m):
    return np.linalg.det(m[:3, :3]) < 0


def points(m, p):
    return np.asarray(p, dtype=float) @ m[:3, :3].T + m[:3, 3]


def vectors(m, v):
    return np.asarray(v, dtype=float) @ m[:3, :3].T


def normals(m, n):
    """By the cofactor matrix, which is the inverse transpose up to a factor > 0 for rotations and
    keeps the outer side outside under mirroring together with swapped corners; unit length."""
    linear = m[:3, :3]
    n = np.asarray(n, dtype=float) @ np.linalg.inv(linear)
    return n / np.linalg.norm(n, axis=-1, keepdims=True)


def similarity_scale(m, path):
    """The factor of a map that scales equally in all directions."""
    s = np.linalg.svd(m[:3, :3], compute_uv=False)
    if s[0] - s[2] > 1e-6 * s[0]:
        raise Unsupported(f"{path}/transform: spheres and disks cannot be scaled unequally")
    return float(s[0])


def frame(z):
    """Matrix whose columns are two axes across the unit vector z, and z."""
    z = np.asarray(z, dtype=float) / np.linalg.norm(z)
    x = np.cross(np.eye(3)[np.argmin(np.abs(z))], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])
