# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the site's own pictures: xvfb-run -a -s "-screen 0 1400x900x24" build/venv/bin/python THIS_FILE"""

import base64
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from meshmark import host, plugin
from meshmark.evidence.drawing import GREY, Array, draw
from meshmark.settings import Method
from numpy.typing import NDArray
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
PICTURES = Path(__file__).resolve().parent / "docs" / "pictures"
MESHES = ROOT / "build" / "data" / "meshes"
ENLARGED = 40


def main() -> None:
    PICTURES.mkdir(exist_ok=True)
    save(methods(MESHES / "bunny00.off"), "methods.png", 32)
    save(evidence(MESHES / "fandisk.off"), "evidence.png", 256)
    save(dialog(MESHES / "bunny00.off"), "dialog.png", 256)


def save(picture: Image.Image, name: str, colors: int) -> None:
    picture.quantize(colors).save(PICTURES / name, optimize=True)


def methods(mesh: Path) -> Image.Image:
    """What each method does to the surface, enlarged: moves along the surface, which nobody sees, left out."""
    with host.own_meshes() as meshes:
        host.read(meshes, mesh)
        original = meshes.current_mesh().vertex_matrix()
        faces = meshes.current_mesh().face_matrix()
        normals = meshes.current_mesh().vertex_normal_matrix()
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    figure, axes = plt.subplots(2, 4, figsize=(13, 6.6), layout="constrained")
    _shaded(axes.flat[0], original, faces, "unmarked")
    for place, method in zip(axes.flat[1:], Method, strict=True):
        with host.own_meshes() as meshes:
            host.read(meshes, mesh)
            report = host.apply(meshes, plugin.EMBED, message="(c) Jane", key="a key", method=method.value)
            moved = meshes.current_mesh().vertex_matrix() - original
        outward = (moved * normals).sum(axis=1)[:, None] * normals
        _shaded(
            place, original + ENLARGED * outward, faces,
            f"{method.value}, {ENLARGED} times enlarged\nMRMS {report['mrms_relative']:.1e} of the diagonal",
        )  # fmt: skip
    return _image(figure)


def evidence(model: Path) -> Image.Image:
    """The picture of a page of evidence: a copy, remeshed and turned, beside the model that it was made from."""
    with tempfile.TemporaryDirectory() as folder:
        shop = Path(folder) / "shop"
        shop.mkdir()
        shutil.copy(model, shop)
        (Path(folder) / "recipients.csv").write_text("recipient\nJane Doe\nBob\n", encoding="utf-8")

        def meshmark(*arguments: str) -> None:
            subprocess.run(
                [sys.executable, "-m", "meshmark", *arguments], cwd=folder, check=True,
                env={**os.environ, "WATERMARK_KEY": "a key"},
            )  # fmt: skip

        meshmark("catalog", "shop", "recipients.csv", "copies", "--method", "Layered")
        copy = next(Path(folder, "copies").glob("*Jane*/*"))
        meshmark("attack", str(copy), "other.off", "--attack", "Remesh")
        meshmark("attack", "other.off", "found.off", "--attack", "Similarity")
        meshmark("report", "found.off", "--ledger", "copies/ledger.sqlite", "--original", "shop")
        page = Path(folder, "found.html").read_text(encoding="utf-8")
        data = re.search(r'src="data:image/png;base64,([^"]*)"', page)[1]
        return Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")


def dialog(mesh: Path) -> Image.Image:
    """The filter's dialog in MeshLab's window, filled in; by the means of the tests. Needs a display."""
    sys.path += [str(ROOT / "tests"), str(ROOT / "tests" / "gui")]
    import test_window as gui

    gui.PICTURES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, subprocess.Popen(["openbox"]) as manager:
        window = gui.Window(mesh, Path(folder))
        try:
            window.open_dialog(gui.EMBED)
            window.fill(gui.EMBED, {"Message": "(c) Jane", "Key": "env:WATERMARK_KEY"})
            x, y, width, height = (
                int(
                    re.search(
                        rf"{name}=(\d+)", gui.xdotool("getwindowgeometry", "--shell", window.find(f"^{gui.EMBED}$"))
                    )[1]
                )
                for name in ("X", "Y", "WIDTH", "HEIGHT")
            )
        finally:
            window.program.kill()
            window.program.wait()
            manager.terminate()
    screen = Image.open(gui.PICTURES / f"{window.pictures:02}-filled.png").convert("RGB")
    return screen.crop((x, y, x + width, y + height))


def _shaded(axes: plt.Axes, points: Array, faces: NDArray[np.int32], title: str) -> None:
    draw(axes, points, faces, np.tile(GREY, (len(faces), 1)))
    axes.set_title(title)


def _image(figure: plt.Figure) -> Image.Image:
    memory = io.BytesIO()
    figure.savefig(memory, dpi=90)
    plt.close(figure)
    return Image.open(memory).convert("RGB")


if __name__ == "__main__":
    main()
