"""Meshes for tests, and stand-ins for mesh objects of other packages."""

import numpy as np

CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)
QUADS = np.array(
    [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
)
TRIANGLES = np.concatenate([QUADS[:, [0, 1, 2]], QUADS[:, [0, 2, 3]]])


class Trimesh:
    """As trimesh.Trimesh."""

    class visual:
        kind = "vertex"
        vertex_colors = np.full((8, 4), 200, np.uint8)

    vertices, faces = CUBE, TRIANGLES


class PyVista:
    """As pyvista.PolyData."""

    points = CUBE.astype(np.float32)
    faces = np.column_stack([np.full(6, 4), QUADS]).reshape(-1)


class Regular:
    """The same by its regular_faces alone."""

    points, regular_faces = CUBE, QUADS


class Open3D:
    """As open3d.geometry.TriangleMesh, whose vectors are sequences that NumPy understands."""

    vertices, triangles = CUBE.tolist(), TRIANGLES.tolist()
    vertex_colors = ()


def sphere(rows=24):
    """(vertices, triangles) of a ball."""
    u, v = np.meshgrid(np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, 2 * rows + 1))
    points = np.stack([np.sin(u) * np.cos(v), np.cos(u), np.sin(u) * np.sin(v)], -1).reshape(-1, 3)
    i = (np.arange(2 * rows)[:, None] * (rows + 1) + np.arange(rows)).reshape(-1)
    quads = np.stack([i, i + 1, i + rows + 2, i + rows + 1], 1)
    return points, np.concatenate([quads[:, [0, 2, 1]], quads[:, [0, 3, 2]]])
