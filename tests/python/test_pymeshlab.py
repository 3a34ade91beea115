# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters in pymeshlab: what they return, what they refuse, and what they leave alone."""

import json
import os
import resource
import subprocess
import sys
from pathlib import Path

import numpy as np
import pymeshlab
import pytest
from doors import CHOICES, DETECT, EMBED, FILTERS, MESHES, ROOT, PyMeshLab, Refused, Value

KEY = "correct horse battery staple"
MESSAGE = "(c) 2026"
MARK: dict[str, Value] = {"Message": MESSAGE, "Key": KEY, "Method": "L-M"}
LM = {"Key": KEY, "Method": "L-M"}
BUNNY = MESHES / "bunny00.off"
FANDISK = MESHES / "fandisk.off"


def opened(*paths: Path) -> pymeshlab.MeshSet:
    PyMeshLab()
    meshes = pymeshlab.MeshSet()
    for path in paths:
        meshes.load_new_mesh(str(path))
    return meshes


@pytest.fixture(scope="module")
def marked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    output = tmp_path_factory.mktemp("marked") / "bunny.ply"
    PyMeshLab().run(EMBED, BUNNY, output, **MARK)
    return output


def test_the_parameters_are_the_contract() -> None:
    meshes = opened(FANDISK)
    for name, parameters in FILTERS.values():
        expected = {
            parameter.lower(): CHOICES[parameter].index(str(default)) if parameter in CHOICES else default
            for parameter, (_, default) in parameters.items()
        }
        found = meshes.filter_parameter_values(name)
        assert list(found) == list(expected)
        assert found == expected


def test_parameters_left_out_take_their_defaults(marked: Path) -> None:
    found = opened(marked).apply_filter("get_watermark", key=KEY, expected=MESSAGE, method="L-M")
    assert found["present"] is True
    assert found["detection_ratio"] == 1
    assert found["p_binomial"] == 2.0**-127  # 128 carriers, and half of the doubt is for other numbers of them
    assert 2.0**-128 < found["p_value"] < 1e-30


def test_the_dict_has_numbers_and_vectors(marked: Path) -> None:
    found = opened(marked).apply_filter("get_watermark", key=KEY, method="L-M")
    assert found["bits"].shape == found["soft"].shape == found["samples"].shape == (128,)
    assert np.array_equal(found["bits"], found["soft"] > 0)
    assert found["warnings"] == 0
    assert found["verdict"] == 1
    assert found["verified"] is True
    embedded = opened(FANDISK).apply_filter("apply_coord_watermark", key=KEY, message=MESSAGE, method="L-M")
    assert {"carriers", "samples_min", "rounds", "moved_vertices", "max_displacement", "mrms"} <= embedded.keys()


def test_the_report_has_all_results(tmp_path: Path) -> None:
    report = PyMeshLab().run(EMBED, FANDISK, Report=str(tmp_path / "report.json"), **MARK)
    assert list(report) == [
        "method", "statistic", "message", "bits", "strength", "trim", "carriers", "layers", "samples_min", "capacity",
        "detection_ratio", "pieces", "loose_pieces", "rounds", "moved_vertices", "guarded_vertices",
        "max_displacement", "mrms", "mrms_relative",
        "diagonal", "change", "seconds", "solver", "version", "warnings", "recipe",
    ]  # fmt: skip
    assert report["method"] == "L-M"
    assert report["statistic"] == "Mean"
    assert set(report["solver"]) == {"mean_iterations", "max_iterations", "not_converged"}
    assert [path.name for path in tmp_path.iterdir()] == ["report.json"]


@pytest.mark.parametrize("message", ["hex:c0ffee", "bits:011001100110", "grüße", "id:4711"])
def test_messages_come_back_as_they_were_given(tmp_path: Path, message: str) -> None:
    output = tmp_path / "marked.ply"
    PyMeshLab().run(EMBED, BUNNY, output, Message=message, Method="Cho", Key=KEY, Bits=0)
    found = PyMeshLab().run(DETECT, output, Method="Cho", Key=KEY, Expected=message)
    assert found["detection_ratio"] == 1
    assert found["present"] is True
    alone = PyMeshLab().run(DETECT, output, Method="Cho", Key=KEY)
    assert alone["message"] == ("" if message.startswith("bits:") else message)  # raw bits prove nothing by themselves


def test_a_rehearsal_says_what_the_mark_survives(tmp_path: Path) -> None:
    report = PyMeshLab().run(EMBED, FANDISK, Report=str(tmp_path / "report.json"), Rehearse=True, **MARK)
    assert set(report["rehearsal"]) == {"noise", "simplify", "smooth", "quantize"}
    assert report["rehearsal"]["noise"] < 1e-6
    assert report["survival"].startswith("survives noise .1 % (p 1e-")
    assert report["recipe"] == json.loads((tmp_path / "report.json").read_text())["recipe"]
    assert f"{report['diagonal']:.4g}" in report["change"]


def test_normals_are_those_that_meshlab_gives_such_a_mesh() -> None:
    meshes = opened(FANDISK)
    meshes.apply_filter("apply_coord_watermark", message=MESSAGE, key=KEY, method="L-M")
    marked = meshes.current_mesh()
    own = pymeshlab.Mesh(marked.vertex_matrix(), marked.face_matrix())  # MeshLab makes its normals
    meshes.add_mesh(own)
    meshes.apply_filter("apply_coord_laplacian_smoothing", stepsmoothnum=0)  # and once more after a filter of its own
    own = meshes.current_mesh()
    assert np.array_equal(own.vertex_matrix(), marked.vertex_matrix())
    assert np.allclose(marked.vertex_normal_matrix(), own.vertex_normal_matrix(), rtol=0, atol=1e-9)
    assert np.allclose(marked.face_normal_matrix(), own.face_normal_matrix(), rtol=0, atol=1e-9)


def test_a_wrong_key_and_an_unmarked_mesh_are_not_present(marked: Path) -> None:
    assert PyMeshLab().run(DETECT, marked, Key="another", Method="L-M", Expected=MESSAGE)["present"] is False
    assert PyMeshLab().run(DETECT, BUNNY, **LM, Expected=MESSAGE)["present"] is False


def test_keys_from_file_and_environment(tmp_path: Path, marked: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "key").write_text(KEY)
    monkeypatch.setenv("WATERMARK_KEY", KEY)
    for key in (f"file:{tmp_path}/key", "env:WATERMARK_KEY"):
        assert PyMeshLab().run(DETECT, marked, Key=key, Method="L-M", Expected=MESSAGE)["present"] is True


@pytest.mark.parametrize("bits", [64, 1025])  # works, fails
def test_a_key_from_a_file_reaches_no_output_and_no_script(tmp_path: Path, bits: int) -> None:
    """All that a process prints, its report, and the script of what it did."""
    (tmp_path / "key").write_text(KEY)
    program = f"""
import pymeshlab
pymeshlab.load_plugin({str(PyMeshLab.plugin)!r})
meshes = pymeshlab.MeshSet(verbose=True)
meshes.load_new_mesh({str(FANDISK)!r})
values = dict(message="{MESSAGE}", method="L-M", key="file:{tmp_path}/key", bits={bits})
try:
    print(meshes.apply_filter("apply_coord_watermark", report="{tmp_path}/report.json", **values))
    print(meshes.apply_filter("get_watermark", key="file:{tmp_path}/key", bits={bits}))
    meshes.save_filter_script("{tmp_path}/script.mlx")
except pymeshlab.PyMeshLabException as error:
    print("refused:", error)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    assert (b"refused:" in done.stdout) == (bits > 1024)
    (tmp_path / "key").unlink()
    written = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert set(written) == (set() if bits > 1024 else {"report.json", "script.mlx"})
    for text in (done.stdout, done.stderr, *written.values()):
        assert KEY.encode() not in text


@pytest.mark.parametrize("threads", [1, 4])
def test_so_many_threads_as_the_environment_asks_for(threads: int) -> None:
    program = f"""
import os
import pymeshlab
pymeshlab.load_plugin({str(PyMeshLab.plugin)!r})
meshes = pymeshlab.MeshSet()
meshes.load_new_mesh({str(FANDISK)!r})
before = len(os.listdir("/proc/self/task"))
meshes.apply_filter("apply_coord_watermark", message="{MESSAGE}", method="L-M", key="{KEY}")
print(1 + len(os.listdir("/proc/self/task")) - before)
"""
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, stdout=subprocess.PIPE, check=True)
    assert int(done.stdout.split()[-1]) == threads


FAILURES: list[tuple[dict[str, Value], str]] = [
    ({"Key": ""}, "key is empty"),
    ({"Key": "file:/no/such/key"}, "key"),
    ({"Key": "env:NO_SUCH_VARIABLE_AT_ALL"}, "NO_SUCH_VARIABLE_AT_ALL"),
    ({"Message": ""}, "message"),
    ({"Message": "far too long for sixty-four bits", "Bits": 64}, "64"),
    ({"Bits": 1025}, "1024"),
    ({"Trim": 0.6}, "0.45"),
    ({"Strength": 0.7}, "must lie above 0"),
    ({"Report": "/no/such/folder/report.json"}, "/no/such/folder/report.json"),
    ({"Report": "/dev/full"}, "/dev/full"),
]


@pytest.mark.parametrize(("values", "text"), FAILURES)
def test_a_failure_says_why_and_changes_nothing(values: dict[str, Value], text: str) -> None:
    meshes = opened(FANDISK)
    before = meshes.current_mesh().vertex_matrix().tobytes()
    with pytest.raises(Refused, match="apply_coord_watermark") as refused:
        PyMeshLab().apply(meshes, EMBED, **{**MARK, **values})
    assert text.lower() in str(refused.value).lower()
    assert KEY not in str(refused.value)
    assert meshes.current_mesh().vertex_matrix().tobytes() == before


def test_a_full_disk_is_an_error_and_changes_nothing(tmp_path: Path) -> None:
    """The limit of this process' file size stands in for the disk's."""
    meshes = opened(FANDISK)
    before = meshes.current_mesh().vertex_matrix().tobytes()
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
    try:
        with pytest.raises(Refused, match="report cannot be written"):
            PyMeshLab().apply(meshes, EMBED, Report=str(tmp_path / "report.json"), **MARK)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert meshes.current_mesh().vertex_matrix().tobytes() == before
    assert list(tmp_path.iterdir()) == []


def test_no_output_takes_the_place_of_another_file_of_the_same_call(tmp_path: Path) -> None:
    (tmp_path / "secret.key").write_text(KEY)
    same, other = str(tmp_path / "secret.key"), str(tmp_path / "sub/../secret.key")
    calls: list[dict[str, Value]] = [
        {**MARK, "Key": f"file:{same}", "Report": other},
        {**MARK, "Certificate": same, "Report": other},
    ]
    for values in calls:
        with pytest.raises(Refused, match="names the same file"):
            PyMeshLab().run(EMBED, FANDISK, **values)
        assert (tmp_path / "secret.key").read_text() == KEY


def test_no_mesh_and_an_empty_mesh_are_refused() -> None:
    emptied = opened(FANDISK)
    emptied.set_selection_all()
    emptied.meshing_remove_selected_vertices_and_faces()
    for meshes, text in ((opened(), "at least one mesh"), (emptied, "face")):
        for filter_name, message in ((EMBED, {"Message": MESSAGE}), (DETECT, {})):
            with pytest.raises(Refused, match=text):
                PyMeshLab().apply(meshes, filter_name, Key=KEY, **message)


def test_all_else_of_the_users_stays(tmp_path: Path) -> None:
    meshes = opened(FANDISK, BUNNY)
    meshes.set_current_mesh(0)
    meshes.compute_selection_by_condition_per_vertex(condselect="x < 0.1")
    meshes.compute_matrix_from_rotation(rotaxis="Z axis", angle=30, freeze=False)

    def rest() -> list[np.ndarray]:
        mesh = meshes.mesh(0)
        return [
            mesh.face_matrix(), mesh.vertex_selection_array(), mesh.transform_matrix(), meshes.mesh(1).vertex_matrix(),
        ]  # fmt: skip

    before, positions, box = rest(), meshes.mesh(0).vertex_matrix(), meshes.mesh(0).bounding_box().diagonal()
    PyMeshLab().apply(meshes, EMBED, **MARK)
    moved = meshes.mesh(0)
    assert not np.array_equal(moved.vertex_matrix(), positions)
    for old, new in zip(before, rest(), strict=True):
        np.testing.assert_array_equal(old, new)
    assert moved.bounding_box().diagonal() != box  # here the mark moves an end of it
    assert moved.bounding_box().diagonal() == pytest.approx(
        np.linalg.norm(np.ptp(moved.vertex_matrix(), axis=0)), rel=1e-12
    )
    corner = moved.vertex_matrix()[moved.face_matrix()]
    normals = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    long = np.linalg.norm(normals, axis=1) > 1e-12
    normals = normals[long] / np.linalg.norm(normals[long], axis=1)[:, None]
    turned = normals @ moved.transform_matrix()[:3, :3].T  # pymeshlab hands out normals with the layer's matrix applied
    np.testing.assert_allclose(moved.face_normal_matrix()[long], turned, atol=1e-6)


def test_what_is_painted_on_the_surface_stays_where_it_was() -> None:
    """Vertices slide along the surface, and what they show is that of the place where they are now."""
    meshes = opened(FANDISK)
    old = meshes.current_mesh().vertex_matrix()
    size = np.linalg.norm(np.ptp(old, axis=0))
    meshes.compute_scalar_by_function_per_vertex(q="z")
    meshes.compute_texcoord_by_function_per_vertex(u="x", v="y")
    meshes.compute_color_by_function_per_vertex(x=f"128+100*x/{size}", y="100", z="7")
    report = PyMeshLab().apply(meshes, EMBED, **MARK)
    mesh = meshes.current_mesh()
    new = mesh.vertex_matrix()
    moved = np.abs(new - old).mean(axis=0)
    off = np.abs(np.column_stack([mesh.vertex_tex_coord_matrix(), mesh.vertex_scalar_array()]) - new).mean(axis=0)
    assert (off < 0.1 * moved).all()
    colors = mesh.vertex_color_matrix() * 255
    assert np.abs(colors[:, 0] - (128 + 100 * new[:, 0] / size)).max() < 1.5
    np.testing.assert_allclose(colors[:, 1:3], np.broadcast_to([100, 7], (len(new), 2)), atol=1e-6)
    assert report["texture_stretch"] < 1.1


def test_a_mesh_without_colours_gets_none() -> None:
    meshes = opened(FANDISK)
    report = PyMeshLab().apply(meshes, EMBED, **MARK)
    assert "texture_stretch" not in report
    assert not meshes.current_mesh().has_vertex_color()
    assert not meshes.current_mesh().has_vertex_scalar()


def test_deleted_elements_do_not_count() -> None:
    """A mesh from which another component was deleted reads like the mesh alone."""
    meshes = opened(BUNNY)
    PyMeshLab().apply(meshes, EMBED, **MARK)
    alone = PyMeshLab().apply(meshes, DETECT, Key=KEY)
    faces = meshes.current_mesh().face_number()
    meshes.load_new_mesh(str(FANDISK))
    meshes.generate_by_merging_visible_meshes(mergevertices=False)
    meshes.compute_selection_by_condition_per_face(condselect=f"fi >= {faces}")
    meshes.meshing_remove_selected_vertices_and_faces()
    assert meshes.current_mesh().face_number() == faces
    assert PyMeshLab().apply(meshes, DETECT, Key=KEY)["soft"] == pytest.approx(alone["soft"], rel=1e-9)


def distinct(points: np.ndarray) -> int:
    return len(np.unique(points, axis=0))


def test_an_stl_stays_closed_and_its_mark_survives_into_ply(tmp_path: Path) -> None:
    """STL files share no vertices: those at one position must move together."""
    soup, output = tmp_path / "soup.stl", tmp_path / "marked.stl"
    meshes = opened(BUNNY)
    meshes.save_current_mesh(str(soup))
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(soup), unify_vertices=False)
    assert meshes.current_mesh().vertex_number() == 3 * meshes.current_mesh().face_number()
    sites = distinct(meshes.current_mesh().vertex_matrix())
    PyMeshLab().apply(meshes, EMBED, **MARK)
    assert distinct(meshes.current_mesh().vertex_matrix()) == sites
    meshes.save_current_mesh(str(output))
    found = PyMeshLab().run(DETECT, output, Expected=MESSAGE, Key=KEY)
    assert found["detection_ratio"] == 1

    meshes = opened(output)
    meshes.meshing_merge_close_vertices(threshold=pymeshlab.PercentageValue(0))
    meshes.save_current_mesh(str(tmp_path / "marked.ply"))
    found = PyMeshLab().run(DETECT, tmp_path / "marked.ply", Expected=MESSAGE, Key=KEY)
    assert found["detection_ratio"] == 1


def test_of_several_layers_it_is_said_which_one(marked: Path) -> None:
    meshes = opened(marked, FANDISK)
    for current, name in ((0, "bunny.ply"), (1, "fandisk.off")):
        meshes.set_current_mesh(current)
        found = PyMeshLab().apply(meshes, DETECT, **LM)
        assert [warning for warning in found["warnings"] if f"layer '{name}' of 2 was looked at" in warning]
    embedded = PyMeshLab().apply(meshes, EMBED, **MARK)
    assert [warning for warning in embedded["warnings"] if "layer 'fandisk.off' of 2 carries the mark" in warning]
    meshes.set_current_mesh(0)
    meshes.set_current_mesh_visibility(False)
    meshes.set_current_mesh(1)
    assert PyMeshLab().apply(meshes, DETECT, **LM)["warnings"] == []  # what is hidden does not count


def test_carriers_are_shown(marked: Path) -> None:
    meshes = opened(marked)
    positions = meshes.current_mesh().vertex_matrix()
    found = PyMeshLab().apply(meshes, DETECT, Key=KEY, ShowCarriers=True)
    assert not meshes.current_mesh().has_vertex_scalar()  # what goes out with the mesh does not tell
    assert not meshes.current_mesh().has_vertex_color()
    shown = meshes.mesh(1)
    assert shown.label().startswith("secret")
    np.testing.assert_array_equal(shown.vertex_matrix(), positions)
    carrier = shown.vertex_scalar_array().astype(int)
    assert list(np.bincount(carrier[carrier >= 0], minlength=64)) == found["samples"]
    colors = shown.vertex_color_matrix()
    for number in (-1, 0, 63):
        assert distinct(colors[carrier == number]) == 1
    np.testing.assert_array_equal(meshes.current_mesh().vertex_matrix(), positions)


def test_measuring_takes_the_other_layer_and_keeps_colours(marked: Path) -> None:
    meshes = opened(FANDISK, marked)
    meshes.compute_color_by_function_per_vertex(x="200", y="100", z="50")
    colors = meshes.current_mesh().vertex_color_matrix().copy()
    assert meshes.apply_filter("get_watermark_distortion")["mrms"] > 0
    np.testing.assert_array_equal(meshes.current_mesh().vertex_color_matrix(), colors)
    with pytest.raises(pymeshlab.PyMeshLabException, match="current layer itself"):
        meshes.apply_filter("get_watermark_distortion", reference=1)
    PyMeshLab.failed.append(meshes)


def test_a_decimal_comma_does_not_matter(tmp_path: Path) -> None:
    """In a process of its own, with a German locale made for it. (MeshLab itself misreads text formats there.)"""
    opened(FANDISK).save_current_mesh(str(tmp_path / "cover.ply"))
    subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", tmp_path / "de_DE.UTF-8"], check=True)
    program = f"""
import locale
locale.setlocale(locale.LC_ALL, "")
assert locale.localeconv()["decimal_point"] == ","
from doors import EMBED, PyMeshLab
PyMeshLab().run(EMBED, {str(tmp_path / "cover.ply")!r}, Report={str(tmp_path / "report.json")!r}, Trim=0.1, **{MARK!r})
"""
    environment = {**os.environ, "LOCPATH": str(tmp_path), "LC_ALL": "de_DE.UTF-8", "PYTHONPATH": str(ROOT / "tests")}
    subprocess.run([sys.executable, "-c", program], env=environment, check=True, timeout=120)
    assert json.loads((tmp_path / "report.json").read_text())["trim"] == 0.1
