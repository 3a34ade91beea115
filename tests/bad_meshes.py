# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that no one should hand in, as vertices and faces, for the tests of both doors."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

Mesh = tuple[np.ndarray, np.ndarray]
NO_FACES = np.zeros((0, 3), dtype=np.int32)


def body(n: int = 48) -> Mesh:
    """A closed bumpy body, longest along x, of n (n + 1) + 2 vertices."""
    u, v = np.meshgrid(np.arange(1, n + 2) * np.pi / (n + 2), np.arange(n) * 2 * np.pi / n, indexing="ij")
    sphere = np.stack([np.cos(u), np.sin(u) * np.cos(v), np.sin(u) * np.sin(v)], axis=-1).reshape(-1, 3)
    points = np.vstack([sphere, [[1, 0, 0], [-1, 0, 0]]])
    bumps = 1 + 0.2 * np.sin(5 * points[:, :1] + 1) * np.cos(4 * points[:, 1:2]) + 0.1 * points[:, 2:]
    top, bottom = len(points) - 2, len(points) - 1
    faces = []
    for j in range(n):
        k = (j + 1) % n
        faces += [(top, j, k), (bottom, n * n + k, n * n + j)]
        for i in range(n):
            a, b, c, d = i * n + j, (i + 1) * n + j, (i + 1) * n + k, i * n + k
            faces += [(a, b, c), (a, c, d)]
    return points * bumps * [2, 1.4, 1], np.array(faces, dtype=np.int32)


def moved(change: Callable[[np.ndarray], np.ndarray]) -> Mesh:
    points, faces = body()
    return change(points), faces


def with_vertex(number: int, value: float) -> Mesh:
    points, faces = body()
    points[number, 1] = value
    return points, faces


def zero_area() -> Mesh:
    points, faces = body()
    for a, b, c in faces[:200]:
        points[c] = (points[a] + points[b]) / 2
    return points, faces


def doubled() -> Mesh:
    points, faces = body()
    faces = faces.copy()
    faces[::3] += len(points)
    return np.vstack([points, points]), faces


def non_manifold() -> Mesh:
    points, faces = body()
    a, b, _ = faces[40]
    return np.vstack([points, 1.3 * points[a : a + 1]]), np.vstack([faces, [[a, b, len(points)]]])


def components() -> Mesh:
    points, faces = body()
    return np.vstack([points, points / 2 + [0, 3, 1]]), np.vstack([faces, faces + len(points)])


def mixed() -> Mesh:
    points, faces = body()
    faces = faces.copy()
    faces[::2] = faces[::2, ::-1]
    return points, faces


BAD_MESHES: dict[str, Callable[[], Mesh]] = {
    "empty": lambda: (np.zeros((0, 3)), NO_FACES),
    "point cloud": lambda: (body()[0], NO_FACES),
    "one face": lambda: (np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0]]), np.array([[0, 1, 2]], dtype=np.int32)),
    "all vertices in one place": lambda: moved(lambda p: p * 0 + 1),
    "all vertices on one sphere": lambda: moved(lambda p: p / np.linalg.norm(p, axis=1, keepdims=True)),
    "a NaN": lambda: with_vertex(7, np.nan),
    "an infinite coordinate": lambda: with_vertex(7, -np.inf),
    "coordinates of 1e30": lambda: moved(lambda p: p * 1e30),
    "coordinates of 1e-30": lambda: moved(lambda p: p * 1e-30),
    "1e6 diagonals from the origin": lambda: moved(lambda p: p + np.array([5e6, 0, 0])),
    "zero-area faces": zero_area,
    "duplicate vertices": doubled,
    "unreferenced vertices": lambda: (np.vstack([body()[0], np.full((500, 3), 9.0)]), body()[1]),
    "non-manifold edge": non_manifold,
    "open": lambda: (body()[0], body()[1][: len(body()[1]) * 2 // 3]),
    "two components": components,
    "inside out": lambda: (body()[0], body()[1][:, ::-1].copy()),
    "mixed orientation": mixed,
}


def write_ply(path: Path, mesh: Mesh) -> None:
    """Binary PLY in float, as meshlabserver keeps it."""
    points, faces = mesh
    rows = np.zeros(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    path.write_bytes(header.encode() + points.astype("<f4").tobytes() + rows.tobytes())
