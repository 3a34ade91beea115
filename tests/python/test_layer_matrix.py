# SPDX-License-Identifier: GPL-3.0-or-later
"""The layer's matrix: where it stretches, what is seen counts; where it is a similarity, no filter minds it.

pymeshlab and MeshLab save points without the matrix, in every format.
"""

import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pymeshlab
import pytest
import trimesh
from bodies import body
from doors import DETECT, DETECT_WITH_ORIGINAL, EMBED, PyMeshLab, Refused, Value

KEY = "correct horse battery staple"
MESSAGE = "id:4711"
MARK: dict[str, Value] = {"Message": MESSAGE, "Key": KEY, "Method": "L-M"}
READ: dict[str, Value] = {"Expected": MESSAGE, "Key": KEY, "Method": "L-M"}
STRETCH = np.diag([1, 1, 1.3, 1])
SHEAR = np.array([[0, -2, 0.4, 5], [2, 0, 0, 6], [0, 0, 1.5, 7], [0, 0, 0, 1]])  # and a turn, and a shift


def opened(points: np.ndarray, faces: np.ndarray, matrix: np.ndarray | None = None) -> pymeshlab.MeshSet:
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(points, faces))
    if matrix is not None:
        meshes.set_matrix(transformmatrix=matrix, freeze=False)
    return meshes


def seen(meshes: pymeshlab.MeshSet) -> np.ndarray:
    return meshes.current_mesh().transformed_vertex_matrix()


def inverse_of(matrix: np.ndarray, points: np.ndarray) -> np.ndarray:
    """The points that the matrix takes to these."""
    return (points - matrix[:3, 3]) @ np.linalg.inv(matrix[:3, :3]).T


@pytest.fixture(scope="module")
def plain() -> tuple[np.ndarray, np.ndarray]:
    mesh = body(3)
    return np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int32)


@pytest.fixture(scope="module")
def marked(plain: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """The same body with the mark, and no matrix."""
    meshes = opened(*plain)
    PyMeshLab().apply(meshes, EMBED, **MARK)
    return meshes.current_mesh().vertex_matrix(), plain[1]


@pytest.mark.parametrize("matrix", [STRETCH, SHEAR, np.diag([1, -1, 1.3, 1])])
def test_what_is_seen_saved_and_frozen_is_one_marked_shape(
    tmp_path: Path, plain: tuple[np.ndarray, np.ndarray], matrix: np.ndarray
) -> None:
    meshes = opened(*plain, matrix)
    before = seen(meshes)
    report = PyMeshLab().apply(meshes, EMBED, **MARK)
    assert any("matrix stretches" in warning for warning in report["warnings"])
    moves = np.linalg.norm(seen(meshes) - before, axis=1)
    assert moves.max() == pytest.approx(report["max_displacement"], rel=1e-5)
    assert PyMeshLab().apply(meshes, DETECT, **READ)["present"] is True
    for name in ("saved.ply", "saved.stl", "saved.obj"):
        meshes.save_current_mesh(str(tmp_path / name))
        assert PyMeshLab().run(DETECT, tmp_path / name, **READ)["present"] is True
    points = seen(meshes)
    meshes.apply_matrix_freeze()
    np.testing.assert_array_equal(seen(meshes), points)
    assert PyMeshLab().apply(meshes, DETECT, **READ)["present"] is True


def write_glb(path: Path, points: np.ndarray, faces: np.ndarray, matrix: np.ndarray) -> None:
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.Trimesh(points, faces, process=False), transform=matrix)
    path.write_bytes(scene.export(file_type="glb"))


def write_3mf(path: Path, points: np.ndarray, faces: np.ndarray, matrix: np.ndarray) -> None:
    """One object, whose place and shape its build item says."""
    vertices = "".join('<vertex x="{:.9g}" y="{:.9g}" z="{:.9g}"/>'.format(*point) for point in points)
    triangles = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*face) for face in faces)
    transform = " ".join(f"{value:.9g}" for value in matrix[:3].T.ravel())
    schemas = "http://schemas.microsoft.com/3dmanufacturing"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(
            "[Content_Types].xml",
            '<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
            '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
            '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>',
        )
        archive.writestr(
            "_rels/.rels",
            '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
            f'<Relationship Id="r" Target="/3D/3dmodel.model" Type="{schemas}/2013/01/3dmodel"/></Relationships>',
        )
        archive.writestr(
            "3D/3dmodel.model",
            f'<?xml version="1.0"?><model unit="millimeter" xmlns="{schemas}/core/2015/02"><resources>'
            f'<object id="1" type="model"><mesh><vertices>{vertices}</vertices>'
            f"<triangles>{triangles}</triangles></mesh>"
            f'</object></resources><build><item objectid="1" transform="{transform}"/></build></model>',
        )


@pytest.mark.parametrize("matrix", [STRETCH, SHEAR])
@pytest.mark.parametrize(("name", "write"), [("node.glb", write_glb), ("item.3mf", write_3mf)])
def test_a_file_that_says_its_shape_by_a_matrix_is_read_as_it_is_seen(
    tmp_path: Path,
    marked: tuple[np.ndarray, np.ndarray],
    name: str,
    write: Callable[[Path, np.ndarray, np.ndarray, np.ndarray], None],
    matrix: np.ndarray,
) -> None:
    points, faces = marked
    write(tmp_path / name, inverse_of(matrix, points), faces, matrix)
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(tmp_path / name))
    np.testing.assert_allclose(meshes.current_mesh().transform_matrix(), matrix, atol=1e-6)
    np.testing.assert_allclose(np.ptp(seen(meshes), axis=0), np.ptp(points, axis=0), rtol=1e-5)
    found = PyMeshLab().apply(meshes, DETECT, **READ)
    assert found["present"] is True
    assert found["detection_ratio"] == 1
    assert any("matrix stretches" in warning for warning in found["warnings"])
    np.testing.assert_allclose(meshes.current_mesh().transform_matrix(), matrix, atol=1e-6)  # reading changes nothing


def test_a_similarity_is_left_alone(marked: tuple[np.ndarray, np.ndarray]) -> None:
    turn = 2.5 * trimesh.transformations.rotation_matrix(0.7, [1, 2, 3])
    turn[:, 3] = 4, 5, 6, 1
    meshes = opened(*marked, turn.astype(np.float32))
    without = PyMeshLab().apply(opened(*marked), DETECT, **READ)
    found = PyMeshLab().apply(meshes, DETECT, **READ)
    assert found["soft"] == without["soft"]
    assert found["warnings"] == []
    PyMeshLab().apply(meshes, EMBED, **{**MARK, "Key": "another"})
    np.testing.assert_array_equal(meshes.current_mesh().transform_matrix(), turn.astype(np.float32))


def test_attacks_see_what_is_seen(plain: tuple[np.ndarray, np.ndarray]) -> None:
    with_matrix, frozen = opened(*plain, SHEAR), opened(*plain, SHEAR)
    frozen.apply_matrix_freeze()
    for attack in ("Noise", "Simplify"):  # the one moves points, the other makes another mesh
        for meshes in (with_matrix, frozen):
            meshes.apply_filter("apply_watermark_attack", attack=attack, seed=5)
        np.testing.assert_array_equal(with_matrix.current_mesh().transform_matrix(), np.eye(4))
        np.testing.assert_allclose(seen(with_matrix), seen(frozen), rtol=0, atol=1e-9)


def test_measuring_and_originals_see_what_is_seen(
    plain: tuple[np.ndarray, np.ndarray], marked: tuple[np.ndarray, np.ndarray]
) -> None:
    meshes = opened(inverse_of(SHEAR, plain[0]), plain[1], SHEAR)
    meshes.add_mesh(pymeshlab.Mesh(*marked))
    stretched = meshes.apply_filter("get_watermark_distortion", reference=0, samples=1000)
    both = opened(*plain)
    both.add_mesh(pymeshlab.Mesh(*marked))
    assert stretched["mrms"] == pytest.approx(both.apply_filter("get_watermark_distortion", samples=1000)["mrms"])
    found = PyMeshLab().apply(meshes, DETECT_WITH_ORIGINAL, Original=0, **READ)
    assert found["present"] is True
    assert found["registration"]["stretch"] < 1e-3


@pytest.mark.parametrize("matrix", [np.diag([1, 1, 0, 1]), np.diag([1, np.inf, 1, 1]), np.diag([0, 0, 0, 1])])
def test_a_singular_matrix_is_refused_and_the_cure_named(
    plain: tuple[np.ndarray, np.ndarray], matrix: np.ndarray
) -> None:
    meshes = opened(*plain, matrix)
    calls = [lambda: PyMeshLab().apply(meshes, EMBED, **MARK), lambda: PyMeshLab().apply(meshes, DETECT, **READ)]
    for call in calls:
        with pytest.raises(Refused, match=r"singular.*Matrix: Reset Current Matrix.*set_matrix_identity"):
            call()
    with pytest.raises(pymeshlab.PyMeshLabException, match="singular"):
        meshes.apply_filter("apply_watermark_attack")
    np.testing.assert_array_equal(meshes.current_mesh().vertex_matrix(), plain[0])
    PyMeshLab.failed.append(meshes)
