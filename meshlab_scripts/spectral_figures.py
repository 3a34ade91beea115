# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws chapter 3's Figure 3.2, a mesh's patches, and Figure 3.3, one patch's spectral coefficients for bit 0 and 1."""

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pymeshlab
from matplotlib import pyplot as plt
from matplotlib.collections import PolyCollection
from meshmark import plugin
from scipy.sparse import coo_matrix, csr_matrix, diags
from tqdm import tqdm

ROOT = Path(__file__).resolve().parents[1]
BITS, TRIM, CUTOFF = 64, 0.1, 2.0
BLUE = (0.25, 0.35, 0.75)


def laplacian(faces: np.ndarray, vertices: int) -> csr_matrix:
    """(3.12) of the whole mesh."""
    edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    ends = np.vstack([edges, edges[:, ::-1]]).T
    adjacency = coo_matrix((np.ones(ends.shape[1]), ends), shape=(vertices, vertices)).tocsr()
    return (diags(np.asarray(adjacency.sum(axis=1)).ravel()) - adjacency).tocsr()


def high_band(graph: csr_matrix, points: np.ndarray) -> np.ndarray:
    """The positions' part above CUTOFF: Jackson-Chebyshev step, as vcg_ext/geometry/chebyshev.h has it."""
    degree = graph.diagonal()
    rows, columns = graph.nonzero()
    bound = np.max((degree[rows] + degree[columns])[rows != columns])
    terms = round(120 * np.sqrt(bound / 24)) + 1
    k, step, edge = np.arange(terms), np.pi / (terms + 1), np.arccos(2 * CUTOFF / bound - 1)
    jackson = ((terms + 1 - k) * np.cos(k * step) + np.sin(k * step) / np.tan(step)) / (terms + 1)
    series = jackson * np.concatenate([[edge / np.pi], 2 * np.sin(k[1:] * edge) / (k[1:] * np.pi)])
    before = points - points.mean(axis=0)
    now = 2 / bound * (graph @ before) - before
    total = series[0] * before + series[1] * now
    for coefficient in tqdm(series[2:], desc="filter", leave=False):
        before, now = now, 2 * (2 / bound * (graph @ now) - now) - before
        total += coefficient * now
    return total


def coefficients(graph: csr_matrix, band: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """The patch's band in the eigenbasis of its part of the Laplacian, in its principal axes (3.19)."""
    _, basis = np.linalg.eigh(graph[patch][:, patch].toarray())
    spectrum = basis.T @ band[patch]
    _, axes = np.linalg.eigh(spectrum.T @ spectrum)
    return spectrum @ axes[:, ::-1]


def opened(path: Path) -> pymeshlab.MeshSet:
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    return meshes


def marked(path: Path, key: str, bit: int) -> pymeshlab.MeshSet:
    meshes = opened(path)
    meshes.apply_filter(
        plugin.EMBED, method="Spectral", message="bits:" + str(bit) * BITS, bits=BITS, trim=TRIM, key=key
    )
    return meshes


def draw_patches(points: np.ndarray, faces: np.ndarray, labels: np.ndarray, output: Path) -> None:
    """Figure 3.2: seen along the third axis. Blue is what is trimmed or spare."""
    centred = points - points.mean(axis=0)
    view = centred @ np.linalg.eigh(centred.T @ centred)[1][:, ::-1]
    corners = view[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    palette = np.array([mpl.colormaps["tab20"](i)[:3] for i in range(20)])
    label = labels[faces[:, 0]]
    colors = np.where(label[:, None] < 0, BLUE, palette[label * 7 % 20]) * (0.45 + 0.55 * np.abs(normals[:, 2:]))
    figure, axes = plt.subplots(figsize=(8, 6))
    axes.add_collection(
        PolyCollection(corners[order, :, :2], facecolors=colors[order], edgecolors=colors[order], linewidths=0.2)
    )
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")
    figure.savefig(output, dpi=150, bbox_inches="tight")


def draw_clouds(clouds: dict[str, np.ndarray], output: Path) -> None:
    """Figure 3.3: the ellipsoid is round for 0 and long for 1."""
    figure = plt.figure(figsize=(4 * len(clouds), 4))
    reach = max(np.percentile(np.abs(cloud), 99) for cloud in clouds.values())
    for place, (title, cloud) in enumerate(clouds.items(), 1):
        axes = figure.add_subplot(1, len(clouds), place, projection="3d")
        axes.scatter(*cloud.T, s=4)
        axes.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(-reach, reach))
        axes.set_box_aspect((1, 1, 1))
        axes.locator_params(nbins=3)
        variances = (cloud**2).sum(axis=0)
        axes.set_title(f"{title}: $\\lambda_1/\\lambda_3$ = {variances[0] / variances[2]:.2f}")
    figure.savefig(output, dpi=150, bbox_inches="tight")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mesh", type=Path, default=ROOT / "build/data/meshes/bunny00.off")
    parser.add_argument("--plugin", type=Path, default=ROOT / "build/meshlab-2025.07/libfilter_watermark.so")
    parser.add_argument("--output", type=Path, default=ROOT / "build/figures", help="folder for the two pictures")
    parser.add_argument("--key", default="figure")
    parser.add_argument("--bit", type=int, default=20, help="number of the bit whose patch Figure 3.3 shows")
    arguments = parser.parse_args()
    mpl.use("agg")
    plugin.load(arguments.plugin)
    arguments.output.mkdir(parents=True, exist_ok=True)

    states = {"unmarked": opened(arguments.mesh)}
    for bit in (0, 1):
        states[f"message {bit}..."] = marked(arguments.mesh, arguments.key, bit)
    reader = states["message 0..."]
    reader.apply_filter(plugin.DETECT, method="Spectral", bits=BITS, trim=TRIM, key=arguments.key, showcarriers=True)
    labels = reader.mesh(1).vertex_scalar_array().astype(int)
    faces = reader.current_mesh().face_matrix()
    draw_patches(reader.current_mesh().vertex_matrix(), faces, labels, arguments.output / "figure-3.2.png")

    graph = laplacian(faces, len(labels))
    patch = np.flatnonzero(labels == arguments.bit)
    clouds = {
        title: coefficients(graph, high_band(graph, meshes.current_mesh().vertex_matrix()), patch)
        for title, meshes in states.items()
    }
    # The key masks the message, so the patch itself tells which of the two carries a 1 here.
    unmarked, *both = clouds.values()
    low, high = sorted(both, key=lambda cloud: np.ptp(np.log((cloud**2).sum(axis=0))))
    clouds = {"unmarked": unmarked, "bit 0": low, "bit 1": high}
    draw_clouds(clouds, arguments.output / "figure-3.3.png")


if __name__ == "__main__":
    main()
