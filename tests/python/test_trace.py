# SPDX-License-Identifier: GPL-3.0-or-later
"""Whose copy is it: the right name through what files go through, nobody for what is not ours, and no guesses."""

import json
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import meshmark
import numpy as np
import pytest
import trimesh
from bodies import body, write_bodies
from dask.distributed import LocalCluster
from meshmark import marking
from meshmark.catalog import Ledger, Order, make_copies
from meshmark.catalog.ledger import Model
from meshmark.catalog.plan import digest
from meshmark.catalog.recipients import Recipient
from meshmark.command.app import main
from meshmark.formats import Body, read_body
from meshmark.key import find_key
from meshmark.reports import DetectReport, Finding
from meshmark.settings import Settings
from meshmark.shape.pieces import pieces
from meshmark.shape.signature import body_signature, difference, signature
from meshmark.tracing import Answer, Trace, trace
from meshmark.tracing.likeness import Likeness
from meshmark.tracing.readings import Evidence, Reading
from meshmark.tracing.verdict import judge

KEY = "correct horse battery staple"


class Shop:
    """A catalogue of two models, one key, one ledger."""

    def __init__(self, folder: Path, scheduler: str, secret: str, buyers: list[str]) -> None:
        self.folder = folder
        self.models = folder / "models"
        self.scheduler = scheduler
        self.key = meshmark.Key(f"file:{folder / 'secret.key'}")
        (folder / "secret.key").write_text(secret)
        write_bodies(self.models, range(2))
        assert self.make(*[Recipient(name, ()) for name in buyers]) == 2 * len(buyers)

    def make(self, *recipients: Recipient) -> int:
        order = Order(self.models, self.folder / "out", list(recipients), self.key, Settings(method="L-M"))
        return make_copies(order, self.folder / "ledger.sqlite", scheduler=self.scheduler).made

    def copy(self, name: str, file: str) -> Path:
        (found,) = (self.folder / "out").glob(f"*-{name}/{file}")
        return found

    def trace(self, path: Path, originals: Path | None = None) -> Trace:
        with Ledger(self.folder / "ledger.sqlite") as ledger:
            return trace(path, ledger, self.key, originals)


@pytest.fixture(scope="module")
def shops(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Shop, Shop]]:
    with LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        address = cluster.scheduler_address
        ours = Shop(tmp_path_factory.mktemp("ours"), address, "our key", ["Jane", "Bob"])
        theirs = Shop(tmp_path_factory.mktemp("theirs"), address, "their key", ["Jane"])
        yield ours, theirs


def loaded(path: Path) -> trimesh.Trimesh:
    return trimesh.load_mesh(path)


def test_a_name_through_formats_mirrors_and_plates(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    shop = shops[0]
    jane = loaded(shop.copy("Jane", "body1.stl"))
    turn = trimesh.transformations.rotation_matrix(1, [1, 2, 3]) @ np.diag([-25.4, 25.4, 25.4, 1])
    jane.copy().apply_transform(turn).export(tmp_path / "mirrored, turned, in inches.glb")
    others = [loaded(shop.copy("Bob", "body1.stl")).apply_translation([200 * k, 0, 0]) for k in (1, 2, 3)]
    trimesh.util.concatenate([body(3), *others]).export(tmp_path / "plate.stl")
    meshmark.attack(shop.copy("Jane", "body1.stl"), tmp_path / "noisy.ply", attack="Noise", amount=0.001)
    for file, name, piece in [
        (shop.copy("Jane", "body1.stl"), "Jane", "the whole file"),
        (tmp_path / "mirrored, turned, in inches.glb", "Jane", "the whole file"),
        (tmp_path / "noisy.ply", "Jane", "the whole file"),
        (tmp_path / "plate.stl", "Bob", "piece "),
    ]:
        result = shop.trace(file)
        assert (result.answer, result.recipient, result.model.name) == (Answer.NAME, name, "body1.stl"), file
        assert result.p < 1e-6
        assert not result.mixed
        assert result.evidence.best.piece.startswith(piece)
        assert name in result.sentence


def test_nobody_for_unmarked_models_and_for_another_shop(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    ours, theirs = shops
    meshmark.attack(ours.models / "body0.stl", tmp_path / "unmarked.ply", attack="Noise", amount=0.0005)
    for file in (tmp_path / "unmarked.ply", theirs.copy("Jane", "body0.stl")):
        result = ours.trace(file)
        found = (result.answer, result.recipient, result.model.name)
        assert found == (Answer.NOBODY, None, "body0.stl"), result.sentence
        assert result.p > 1e-6


def test_no_guess_where_it_cannot_be_told(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    shop = shops[0]
    meshmark.attack(shop.copy("Jane", "body0.stl"), tmp_path / "ruined.ply", attack="Noise", amount=0.03)
    meshmark.attack(shop.copy("Jane", "body0.stl"), tmp_path / "coarse.ply", attack="Simplify", amount=0.95)
    for name in ("coarse.ply", "ruined.ply"):
        result = shop.trace(tmp_path / name)
        assert (result.answer, result.recipient) == (Answer.CANNOT_TELL, None), result.sentence


def test_nobody_of_a_plate_only_where_each_piece_is_a_model(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    shop = shops[0]
    meshmark.attack(shop.copy("Jane", "body0.stl"), tmp_path / "ruined.ply", attack="Noise", amount=0.03)
    unmarked = [body(number).apply_translation([400 * number, 0, 0]) for number in range(2)]
    for second, answer in ((unmarked[1], Answer.NOBODY), (loaded(tmp_path / "ruined.ply"), Answer.CANNOT_TELL)):
        trimesh.util.concatenate([unmarked[0], second.apply_translation([0, 400, 0])]).export(tmp_path / "plate.stl")
        result = shop.trace(tmp_path / "plate.stl")
        assert (result.answer, result.recipient) == (answer, None), result.sentence


def test_a_copy_that_is_not_in_the_ledger_names_nobody(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    shop = shops[0]
    source = shop.models / "body0.stl"
    meshmark.embed(source, tmp_path / "x.stl", message="id:5", key=shop.key, method="L-M")
    result = shop.trace(tmp_path / "x.stl")
    assert (result.answer, result.recipient) == (Answer.CANNOT_TELL, None)
    assert "id:5" in result.sentence


def test_a_mark_in_another_object_names_nobody(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    """Marks of vertex norms can be copied by who has a marked copy; the shape cannot be made to fit."""
    shop = shops[0]
    with Ledger(shop.folder / "ledger.sqlite") as ledger:
        ((_, messages),) = ledger.candidates().items()
    body(3).apply_scale([1, 1, 2]).export(tmp_path / "other.stl")
    for message in messages.values():
        meshmark.embed(
            tmp_path / "other.stl", tmp_path / "framed.stl", message=f"id:{message}", key=shop.key, method="L-M"
        )
        result = shop.trace(tmp_path / "framed.stl")
        assert (result.answer, result.recipient) == (Answer.CANNOT_TELL, None), result.sentence
        assert result.p < 1e-6
        assert "another object" in result.sentence

    framed, beside = loaded(tmp_path / "framed.stl"), body(0).apply_translation([400, 0, 0])
    inside = framed.copy().apply_transform(np.diag([0.2, 0.2, 0.2, 1]))  # a plate that is body0 by its shape as a whole
    for number, plate in enumerate([(framed, beside), (beside, framed), (body(0), inside)]):
        file = tmp_path / f"plate{number}.stl"
        trimesh.util.concatenate(plate).export(file)
        for originals in (None, shop.models):
            result = shop.trace(file, originals)
            assert (result.answer, result.recipient) == (Answer.CANNOT_TELL, None), result.sentence
            assert result.p < 1e-6


def test_of_models_of_one_shape_the_one_that_the_recipient_has(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    """Two files of one shape, and then another shape in the first one's place: each copy is of its own model."""
    theirs = shops[1]
    body(2).export(theirs.models / "body2.ply")
    body(2).export(theirs.models / "body2.stl")
    kim, lee = Recipient("Kim", ("body2.stl",)), Recipient("Lee", ("body2.ply",))
    assert theirs.make(kim, lee) == 2
    body(3).export(theirs.models / "body2.stl")
    assert theirs.make(kim, lee) == 1
    meshmark.attack(theirs.copy("Kim", "body2.stl"), tmp_path / "part.ply", attack="Crop", amount=0.3)
    for file, name, model, sha256 in [
        (theirs.copy("Kim", "body2.stl"), "Kim", "body2.stl", None),
        (theirs.copy("Lee", "body2.ply"), "Lee", "body2.ply", digest(theirs.models / "body2.ply")),
        (theirs.copy("Kim", "body2-2.stl"), "Kim", "body2.stl", digest(theirs.models / "body2.stl")),
        (tmp_path / "part.ply", "Kim", "body2.stl", None),
    ]:
        result = theirs.trace(file, theirs.models)
        assert (result.answer, result.recipient, result.model.name) == (Answer.NAME, name, model), result.sentence
        assert (result.model.sha256 == sha256) == (sha256 is not None)


def test_a_part_is_read_with_the_original(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    shop = shops[0]
    meshmark.attack(shop.copy("Bob", "body1.stl"), tmp_path / "part.ply", attack="Crop", amount=0.3)
    assert shop.trace(tmp_path / "part.ply").answer == Answer.CANNOT_TELL
    result = shop.trace(tmp_path / "part.ply", shop.models)
    assert (result.answer, result.recipient, result.model.name) == (Answer.NAME, "Bob", "body1.stl"), result.sentence
    assert result.evidence.tries == 1 + 2  # blind, and with either model


def test_p_counts_candidates_and_readings(shops: tuple[Shop, Shop], tmp_path: Path) -> None:
    """One message looked for by itself reads better by the factor of what else was looked for, and looked at."""
    shop = shops[0]
    trimesh.util.concatenate([loaded(shop.copy("Bob", "body0.stl")), body(3).apply_translation([300, 0, 0])]).export(
        tmp_path / "two.stl"
    )
    result = shop.trace(tmp_path / "two.stl")
    best = result.evidence.best
    assert [one.piece for one in result.evidence.readings] in (
        ["piece 1 of 2"],
        ["piece 1 of 2", "piece 2 of 2"],
    )
    assert (result.evidence.candidates, result.evidence.tries) == (2, 3)
    assert result.p == pytest.approx(3 * best.p)
    alone = meshmark.detect(
        shop.copy("Bob", "body0.stl"), key=shop.key, method="L-M", bits=64, expected=best.report.message
    ).p_value
    assert best.p == pytest.approx(2 * alone, rel=1e-3)


def test_the_command_says_it_by_its_exit_code(
    shops: tuple[Shop, Shop], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shop = shops[0]
    body(6).export(tmp_path / "another object.stl")
    options = ["--ledger", str(shop.folder / "ledger.sqlite"), "--key-file", str(shop.folder / "secret.key")]
    for file, code in [
        (shop.copy("Jane", "body0.stl"), 0),
        (shop.models / "body0.stl", 1),
        (tmp_path / "nothing.stl", 2),
        (tmp_path / "another object.stl", 3),
    ]:
        said = []
        for form in ([], ["--json"]):
            monkeypatch.setattr(sys, "argv", ["meshmark", "trace", *options, *form, str(file)])
            with pytest.raises(SystemExit) as left:
                main()
            assert left.value.code == code, file
            said.append(capsys.readouterr().out)
        if code != 2:
            assert json.loads(said[1])["sentence"] in " ".join(said[0].split())


def test_a_signature_is_that_of_the_shape(tmp_path: Path) -> None:
    """A box of edges a, b, c by hand; turned, moved, scaled, mirrored and cut finer it has the same numbers."""
    a, b, c = 1.0, 2.0, 3.0
    box = trimesh.creation.box([a, b, c])
    found = signature(box.vertices, box.faces.astype(np.int32))
    radius = (a * b * c * 3 / (4 * np.pi)) ** (1 / 3)
    assert found[0] == pytest.approx(np.sqrt(2 * (a * b + b * c + c * a) / (4 * np.pi)) / radius)
    assert found[1:4] == pytest.approx(np.array([a, b, c]) / np.sqrt(12) / radius)
    assert found[7] == pytest.approx(0, abs=1e-5)

    shape = body(1, level=3)
    plain = signature(shape.vertices, shape.faces.astype(np.int32))
    turn = trimesh.transformations.rotation_matrix(1, [1, 2, 3], [40, 5, 6]) @ np.diag([-3, 3, 3, 1])
    other = shape.subdivide().apply_transform(turn)
    assert signature(other.vertices, other.faces.astype(np.int32)) == pytest.approx(plain, rel=1e-9)
    open_one = shape.copy()
    open_one.update_faces(np.arange(len(shape.faces)) != 7)
    assert signature(open_one.vertices, open_one.faces.astype(np.int32))[:4] == pytest.approx(plain[:4], rel=1e-2)

    write_bodies(tmp_path, range(8))
    signatures = [body_signature(read_body(path)) for path in sorted(tmp_path.iterdir())]
    apart = [difference(x, y) for n, x in enumerate(signatures) for y in signatures[:n]]
    meshmark.embed(tmp_path / "body1.stl", tmp_path / "marked.stl", message="id:1", key=KEY, method="L-M")
    marked = body_signature(read_body(tmp_path / "marked.stl"))
    assert difference(marked, body_signature(read_body(tmp_path / "body1.stl"))) < min(apart) / 4


def test_pieces_are_the_large_ones() -> None:
    big, small, crumb = (trimesh.creation.box([edge] * 3) for edge in (10, 3, 0.1))
    scene = trimesh.util.concatenate([small.apply_translation([20, 0, 0]), crumb.apply_translation([30, 0, 0]), big])
    found = pieces(Body(scene.vertices, scene.faces.astype(np.int32), "mm", lambda path, points: None))
    assert [(piece.name, len(piece.faces)) for piece in found] == [
        ("the whole file", 36),
        ("piece 1 of 3", 12),
        ("piece 2 of 3", 12),
    ]
    assert found[1].points.max() == 5


def model(faces: int) -> Model:
    return Model(1, "a.stl", "", 0, faces // 2, faces, "mm", ())


def test_on_a_coarse_model_a_mark_may_be_lost_by_little() -> None:
    touched, little = (
        Likeness("the whole file", model(3000), 2e-4, 1e-4, 1),
        Likeness("the whole file", model(3000), 2e-4, 3e-4, 1),
    )
    assert touched.intact
    assert not little.intact
    assert Likeness("the whole file", model(30000), 0.01, 0.01, 0.9).intact


def told(finding: Finding, presence: float | None = None, **more: object) -> Evidence:
    """Of a file that was read once."""
    report = DetectReport(
        method="Layered", statistic="Mean", carriers=64, bits="", message="", trim=0, soft=[], samples=[], p_message=1,
        verified=False, verdict="", finding=finding, presence=presence, **more,
    )  # fmt: skip
    return Evidence([Reading("the whole file", Settings(), None, report=report)], 1, 1)


def test_a_mark_of_this_key_without_a_message_is_neither_nobodys_nor_of_another_key(shops: tuple[Shop, Shop]) -> None:
    """Though the shape is intact."""
    likes = {"the whole file": [Likeness("the whole file", model(30_000), 0, 0, 1)]}
    with Ledger(shops[0].folder / "ledger.sqlite") as ledger:
        for presence in (1e-9, 5e-7, 1e-4):
            result = judge(told(Finding.NO_MESSAGE, presence), likes, ledger)
            assert result.answer == Answer.CANNOT_TELL
            assert "this key" in result.sentence
            assert "another key" not in result.sentence
        for finding, another in ((Finding.ANOTHER_KEY, True), (Finding.NOT_FOUND, False)):
            result = judge(told(finding, 0.5), likes, ledger)
            assert result.answer == Answer.NOBODY
            assert ("another key" in result.sentence) == another


def test_what_reads_from_some_part_names_nobody(shops: tuple[Shop, Shop]) -> None:
    """Though the file as a whole is a model that the recipient has: it is not what was read."""
    shop = shops[0]
    with Ledger(shop.folder / "ledger.sqlite") as ledger:
        copy = ledger.copies()[0]
        own = next(one for one in ledger.models() if one.id == copy.model)
        likes = {"the whole file": [Likeness("the whole file", own, 0, 0, 1)]}
        for parts, answer in ((None, Answer.NAME), ([{"p_value": 1e-12}], Answer.CANNOT_TELL)):
            whole = told(Finding.PRESENT, parts=parts)
            best = replace(whole.best, settings=copy.recipe, recipient=copy.recipient, p=1e-12)
            assert judge(replace(whole, readings=[best]), likes, ledger).answer == answer
            other = replace(best, settings=replace(copy.recipe, bits=copy.recipe.bits + 1))
            assert judge(replace(whole, readings=[other]), likes, ledger).answer == Answer.CANNOT_TELL


def test_a_neighbour_of_a_proven_message_is_not_named(
    shops: tuple[Shop, Shop], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Words of the code can be near each other: then who is looked for reads well where another one's message is."""
    found = told(Finding.ANOTHER_MESSAGE, p_value=1e-12, candidate=1, runner_up_p=1).best.report
    report = replace(found, message="id:5", p_message=1e-9, verified=True)
    monkeypatch.setattr(marking, "detect", lambda *_, **__: report)
    result = shops[0].trace(shops[0].models / "body0.stl")
    assert result.answer == Answer.CANNOT_TELL
    assert "id:5" in result.sentence


def test_p_of_a_single_recipient_is_that_of_a_list(shops: tuple[Shop, Shop], monkeypatch: pytest.MonkeyPatch) -> None:
    """That of one message is no bound for a copy that somebody else has."""
    asked = []
    report = told(Finding.PRESENT, p_value=1e-12, candidate=1, runner_up_p=1).best.report
    monkeypatch.setattr(marking, "detect", lambda *_, expected, **__: asked.append(expected) or report)
    monkeypatch.setattr(Ledger, "candidates", lambda self, own=Ledger.candidates: {
        settings: dict(list(group.items())[:1]) for settings, group in own(self).items()
    })  # fmt: skip
    assert shops[0].trace(shops[0].models / "body0.stl").recipient
    assert all(len(list_) == 2 for list_ in asked)
    assert asked


def test_a_reading_that_failed_is_not_nobodys(shops: tuple[Shop, Shop], monkeypatch: pytest.MonkeyPatch) -> None:
    def narrow(*_: object, **__: object) -> None:
        raise meshmark.Failed("Not enough memory.")

    shop = shops[0]
    monkeypatch.setattr(marking, "detect", narrow)
    with Ledger(shop.folder / "ledger.sqlite") as ledger, pytest.raises(meshmark.Failed):
        trace(shop.models / "body0.stl", ledger, find_key(shop.key))
