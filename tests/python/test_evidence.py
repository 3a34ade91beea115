# SPDX-License-Identifier: GPL-3.0-or-later
"""The page for a take-down, and the alignment that its pictures rest on."""

import base64
import io
import re
from html.parser import HTMLParser
from pathlib import Path

import matplotlib.image
import meshmark
import numpy as np
import pytest
import trimesh
from bodies import body, write_bodies
from dask.distributed import LocalCluster
from meshmark.bounds import odds, rounded_up
from meshmark.catalog import Ledger, Order, make_copies
from meshmark.catalog.plan import digest
from meshmark.catalog.recipients import Recipient
from meshmark.evidence import write_page
from meshmark.settings import Settings
from meshmark.shape.alignment import laid_on
from meshmark.tracing import trace


def test_a_part_is_laid_on_the_model_at_any_size_place_and_chirality() -> None:
    model = body(1, level=3)
    turn = trimesh.transformations.rotation_matrix(2, [3, 1, 2], [40, 5, 6]) @ np.diag([-3, 3, 3, 1])
    part = model.copy()
    part.update_faces(part.triangles_center[:, 0] <= np.quantile(part.triangles_center[:, 0], 0.75))
    found = part.copy().apply_transform(turn)
    laid = laid_on(found.vertices, found.faces, model.vertices, model.faces)
    apart = np.linalg.norm(laid - part.vertices, axis=1)[np.unique(part.faces)]
    assert apart.max() < 0.005 * np.linalg.norm(model.extents)


@pytest.mark.parametrize(
    ("p", "text"),
    [(1, "1"), (0.25, "0.25"), (0.02, "1 in 50"), (2e-7, "1 in 5 million"), (3e-19, "1 in 10^18")],
)
def test_odds_in_words(p: float, text: str) -> None:
    assert odds(p) == text


def test_what_is_printed_stays_a_bound() -> None:
    """Never below p, and above it by what rounding takes: a tenth, a half of the odds, or a power of ten."""
    names = {"thousand": 10**3, "million": 10**6, "thousand million": 10**9}
    sweep = [*np.geomspace(1e-300, 1, 3000), *np.nextafter(10.0 ** np.arange(-20, 0), 1), 1.04e-9, 0.994]
    for p in sweep:
        said, word = odds(p), rounded_up(p)
        number, _, name = said.removeprefix("1 in ").replace(",", "").partition(" ")
        power = number.startswith("10^")
        one_in = 10 ** int(number[3:]) if power else int(number) * names.get(name, 1) if "in" in said else None
        chance = 1 / one_in if one_in else float(said)
        assert p <= float(word) <= 1.1 * p, word
        assert p <= chance <= (10 if power else 2) * p, said


class Text(HTMLParser):
    """What a reader of the page reads; fails on tags that do not match."""

    def __init__(self) -> None:
        super().__init__()
        self.text = ""
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


def test_the_page_has_all_that_somebody_else_needs(tmp_path: Path) -> None:
    write_bodies(tmp_path / "models", range(1))
    (tmp_path / "secret.key").write_text("the key itself")
    key = meshmark.Key(f"file:{tmp_path / 'secret.key'}")
    order = Order(tmp_path / "models", tmp_path / "out", [Recipient("<b>Jane & Co", ())], key, Settings(method="L-M"))
    with LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        make_copies(order, tmp_path / "ledger.sqlite", scheduler=cluster.scheduler_address)
        before = digest(order.models / "body0.stl")
        body(5).export(order.models / "body0.stl")
        make_copies(order, tmp_path / "ledger.sqlite", scheduler=cluster.scheduler_address)
    (copy,) = (tmp_path / "out").rglob("body0-2.stl")  # of the model as it is now
    found = tmp_path / "found.stl"
    trimesh.load_mesh(copy).apply_transform(trimesh.transformations.rotation_matrix(1, [1, 2, 3])).export(found)
    page = tmp_path / "page.html"
    with Ledger(tmp_path / "ledger.sqlite") as ledger:
        write_page(page, found, trace(found, ledger, key), ledger, tmp_path / "models")
        check = ledger.key_check
    reader = Text()
    reader.feed(page.read_text(encoding="utf-8"))
    assert reader.open == []
    for words in (
        "<b>Jane & Co: it is the copy of 'body0.stl'", digest(found), digest(copy), digest(order.models / "body0.stl"),
        check, "at most 1 in 10^", "What would refute it", "meshmark trace found.stl", "2025.7", "0.9.0",
    ):  # fmt: skip
        assert words in reader.text
    assert before not in reader.text
    assert "the key itself" not in page.read_text(encoding="utf-8")
    assert not re.search(r"(src|href)=\"(?!data:)", page.read_text(encoding="utf-8")), "one file, nothing fetched"
    (encoded,) = re.findall(r"base64,([^\"]+)", page.read_text(encoding="utf-8"))
    pixels = matplotlib.image.imread(io.BytesIO(base64.b64decode(encoded)))
    assert pixels.shape[1] > 1000
    assert 0.1 < (pixels[..., :3].min(axis=2) < 0.9).mean() < 0.7  # bodies, and white around them
