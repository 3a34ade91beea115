# SPDX-License-Identifier: GPL-3.0-or-later
"""Detection with the original at hand, through every door."""

from pathlib import Path

import pymeshlab
import pytest
from doors import DETECT_WITH_ORIGINAL, DOORS, EMBED, MESHES, PyMeshLab, Refused, Value

KEY = "correct horse battery staple"
MESSAGE = "(c) 2026"
ORIGINAL = MESHES / "bunny00.off"
FANDISK = MESHES / "fandisk.off"

pytestmark = pytest.mark.usefixtures("display")


@pytest.fixture(scope="module")
def marked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("marked") / "marked.ply"
    PyMeshLab().run(EMBED, ORIGINAL, path, Message=MESSAGE, Key=KEY)
    return path


@pytest.fixture(scope="module")
def piece(marked: Path) -> Path:
    """A third of the marked mesh, elsewhere and at another size."""
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(marked))
    meshes.apply_filter("apply_watermark_attack", attack="Crop", amount=0.67, seed=4)
    meshes.apply_filter("apply_watermark_attack", attack="Similarity", seed=4)
    path = marked.parent / "piece.ply"
    meshes.save_current_mesh(str(path))
    return path


def test_a_piece_is_read_through_every_door(piece: Path) -> None:
    asked: dict[str, Value] = {"Key": KEY, "Expected": MESSAGE}
    reports = {
        name: door().run(DETECT_WITH_ORIGINAL, piece, before=ORIGINAL, Original=0, **asked)
        for name, door in DOORS.items()
    }
    for name, report in reports.items():
        assert report["present"] is True, name
        assert report["registration"]["found"] is True, name
        assert report["registration"]["overlap"] > 0.97, name
        assert 0.3 < report["registration"]["scale"] < 3, name
    first, second = reports.values()
    # The hosts store the original in float and in double.
    assert first["registration"]["scale"] == pytest.approx(second["registration"]["scale"], rel=1e-4)
    assert first["bits"] == second["bits"]


def test_the_dict_has_the_registration_and_meshes_stay(marked: Path) -> None:
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(ORIGINAL))
    meshes.load_new_mesh(str(marked))
    before = meshes.current_mesh().vertex_matrix()
    found = meshes.apply_filter("get_watermark_with_original", original=0, key=KEY, expected=MESSAGE)
    assert found["present"] is True
    assert found["registration_found"] is True
    assert found["registration_scale"] == pytest.approx(1, rel=1e-4)
    assert len(found["registration_pose"]) == 16
    assert (meshes.current_mesh().vertex_matrix() == before).all()


def test_a_certificate_takes_the_originals_place_through_every_door(tmp_path: Path) -> None:
    asked: dict[str, Value] = {"Method": "Waves", "Key": KEY}
    for name, door in DOORS.items():
        certificate = tmp_path / name
        suspect = tmp_path / f"{name}.ply"
        door().run(EMBED, FANDISK, suspect, Certificate=str(certificate), Message=MESSAGE, **asked)
        assert 20_000 < certificate.stat().st_size < 30_000, name
        assert KEY.encode() not in certificate.read_bytes(), name
        report = door().run(DETECT_WITH_ORIGINAL, suspect, Certificate=str(certificate), Expected=MESSAGE, **asked)
        assert report["present"] is True, name
        assert report["registration"]["overlap"] > 0.97, name


def test_bad_certificates_are_named(marked: Path, tmp_path: Path) -> None:
    door = PyMeshLab()
    whole = tmp_path / "whole"
    door.run(EMBED, FANDISK, Certificate=str(whole), Message=MESSAGE, Key=KEY, Method="Waves")
    cut = tmp_path / "cut"
    cut.write_bytes(whole.read_bytes()[:-100])
    for path, text in ((cut, "cut off"), (marked, "no certificate"), (tmp_path / "none", "cannot be read")):
        with pytest.raises(Refused, match=text):
            door.run(DETECT_WITH_ORIGINAL, marked, Certificate=str(path), Key=KEY)
    with pytest.raises(Refused, match="another key"):
        door.run(DETECT_WITH_ORIGINAL, marked, Certificate=str(whole), Key="another")
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(ORIGINAL))
    before = meshes.current_mesh().vertex_matrix()
    for values, text in (
        ({"Method": "Geodesic", "Certificate": str(tmp_path / "never")}, "needs the original itself"),
        ({"Certificate": "/no/such/folder/certificate"}, "/no/such/folder/certificate"),
    ):
        with pytest.raises(Refused, match=text):
            door.apply(meshes, EMBED, Message=MESSAGE, Key=KEY, **values)
    assert not (tmp_path / "never").exists()
    assert (meshes.current_mesh().vertex_matrix() == before).all()


def test_bad_choices_of_the_original_are_named(marked: Path) -> None:
    door = PyMeshLab()
    with pytest.raises(Refused, match="current layer itself"):
        door.run(DETECT_WITH_ORIGINAL, marked, before=ORIGINAL, Original=1, Key=KEY)
    with pytest.raises(Refused, match="carries a mark of this key itself"):
        door.run(DETECT_WITH_ORIGINAL, ORIGINAL, before=marked, Original=0, Key=KEY, Expected=MESSAGE)
