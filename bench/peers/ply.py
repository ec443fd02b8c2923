"""Meshes to binary PLY files, as Mitsuba reads them."""
import numpy as np


def write_ply(path, mesh):
    columns = [("x", "y", "z"), mesh.positions], [("nx", "ny", "nz"), mesh.normals], \
        [("u", "v"), mesh.uvs], [("r", "g", "b"), mesh.colours]
    columns = [(names, values) for names, values in columns if values is not None]
    properties = "".join(f"property float {name}\n" for names, _ in columns for name in names)
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh.positions)}\n"
              f"{properties}element face {len(mesh.indices)}\n"
              "property list uchar int vertex_indices\nend_header\n")
    faces = np.empty(len(mesh.indices), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, mesh.indices
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(np.hstack([values for _, values in columns]).astype("<f4").tobytes())
        file.write(faces.tobytes())
