# SPDX-License-Identifier: GPL-3.0-or-later
"""A catalogue's copies: whole, each once, whatever kills the run; and a ledger that always agrees with the files."""

import errno
import hashlib
import os
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import meshmark
import pytest
import trimesh
from bodies import body, write_bodies
from dask.distributed import LocalCluster
from meshmark.catalog import Ledger, Order, Outcome, forecast, make_copies, work
from meshmark.catalog import ledger as ledger_module
from meshmark.catalog import run as run_module
from meshmark.catalog.recipients import Recipient, fits, read_recipients
from meshmark.command import catalog as catalog_command
from meshmark.command.app import main
from meshmark.settings import Settings

KEY = "correct horse battery staple"
SCHEDULER = ""
COMMAND = Path(sys.executable).parent / "meshmark"


@pytest.fixture(scope="module")
def scheduler() -> Iterator[str]:
    """Of a worker in this process: starting others takes longer than all that is tested here."""
    with LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        yield cluster.scheduler_address


@pytest.fixture
def order(tmp_path: Path, scheduler: str, monkeypatch: pytest.MonkeyPatch) -> Order:
    monkeypatch.setattr(sys.modules[__name__], "SCHEDULER", scheduler)
    (tmp_path / "secret.key").write_text(KEY)
    write_bodies(tmp_path / "models", range(1))
    (tmp_path / "who.csv").write_text("recipient\nJane Doe\nÅke\n", encoding="utf-8")
    return Order(
        tmp_path / "models",
        tmp_path / "out",
        read_recipients(tmp_path / "who.csv"),
        meshmark.Key(f"file:{tmp_path / 'secret.key'}"),
        Settings(method="L-M"),
    )


def made(order: Order, **options: object) -> object:
    return make_copies(order, order.copies / "ledger.sqlite", scheduler=SCHEDULER, **options)


def visible(folder: Path) -> dict[str, str]:
    """The finished files and their hashes."""
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in folder.rglob("*.stl")
        if not path.name.startswith(".")
    }


def entered(folder: Path, finished: bool = True) -> dict[str, str]:
    """The ledger's files and hashes; not those on their way where only finished ones are wanted."""
    with closing(sqlite3.connect(folder / "ledger.sqlite")) as sql:
        where = "WHERE part IS NULL" if finished else ""
        return dict(sql.execute(f"SELECT file, sha256 FROM copies {where}"))


def test_each_copy_says_whose_it_is_and_the_ledger_knows(order: Order) -> None:
    outcome = made(order)
    assert (outcome.made, outcome.before, outcome.refused, outcome.broken) == (2, 0, {}, {})
    assert 0 < outcome.embedded < outcome.worked
    assert visible(order.copies) == entered(order.copies)
    with Ledger(order.copies / "ledger.sqlite") as ledger:
        names = ledger.recipients()
        assert sorted(name for name, _ in names.values()) == ["Jane Doe", "Åke"]
        for copy in ledger.copies():
            message = f"id:{names[copy.recipient][1]}"
            found = meshmark.detect(order.copies / copy.file, expected=message, key=KEY, **copy.recipe.values())
            assert found.found
            assert copy.figures["mrms_relative"] < 1e-4
    assert not [path for path in order.copies.rglob("*") if path.is_file() and KEY.encode() in path.read_bytes()]
    again = made(order)
    assert (again.made, again.before) == (0, 2)


def test_killed_halfway_and_run_again_all_are_there_and_none_twice(order: Order, tmp_path: Path) -> None:
    write_bodies(order.models, range(2))
    (tmp_path / "who.csv").write_text("recipient\n" + "".join(f"buyer {n}\n" for n in range(6)))
    line = [COMMAND, "catalog", "models", "who.csv", "out", "--method", "L-M", "--workers", "1", "--key-file",
            "secret.key"]  # fmt: skip
    quiet = {"stderr": subprocess.DEVNULL, "stdout": subprocess.DEVNULL}
    with subprocess.Popen(line, cwd=tmp_path, start_new_session=True, **quiet) as run:
        while run.poll() is None and len(visible(order.copies)) < 5:
            time.sleep(0.02)
        assert run.poll() is None, "it was done before it could be killed"
        os.killpg(run.pid, signal.SIGKILL)  # its worker, too
    files = visible(order.copies)
    assert entered(order.copies).items() <= files.items() <= entered(order.copies, finished=False).items()
    kept = {name: (order.copies / name).stat().st_mtime_ns for name in entered(order.copies)}

    outcome = made(replace(order, recipients=read_recipients(tmp_path / "who.csv")))
    files = visible(order.copies)
    assert len(files) == 12
    assert files == entered(order.copies)
    assert outcome.made + outcome.before == 12
    assert outcome.before >= 4
    assert all((order.copies / name).stat().st_mtime_ns == when for name, when in kept.items())
    assert not list(order.copies.rglob(".part*"))


def test_a_crash_between_entry_and_file_is_settled(order: Order, monkeypatch: pytest.MonkeyPatch) -> None:
    """The one moment in which they do not agree."""

    def crash(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(ledger_module, "_bring", crash)
        with pytest.raises(KeyboardInterrupt):
            made(order)
    assert visible(order.copies) == {}
    assert len(entered(order.copies, finished=False)) == 1
    assert (made(order).made, len(visible(order.copies))) == (1, 2)
    assert visible(order.copies) == entered(order.copies)
    with closing(sqlite3.connect(order.copies / "ledger.sqlite")) as sql, sql:
        (name,) = sql.execute("SELECT file FROM copies").fetchone()
        sql.execute("UPDATE copies SET part = 'gone' WHERE file = ?", (name,))
    (order.copies / name).unlink()  # lost on its way
    assert made(order).made == 1
    assert visible(order.copies) == entered(order.copies)


def test_a_forecast_leaves_nothing(order: Order, tmp_path: Path) -> None:
    plan = forecast(order, order.copies / "ledger.sqlite", workers=2)
    assert (plan.copies, plan.before, plan.bytes) == (2, 0, 2 * sum(p.stat().st_size for p in order.models.iterdir()))
    assert plan.seconds > 0
    assert not order.copies.exists()
    made(replace(order, recipients=order.recipients[:1]))
    before = entered(order.copies)
    plan = forecast(order, order.copies / "ledger.sqlite")
    assert (plan.copies, plan.before) == (1, 1)
    assert entered(order.copies) == before == visible(order.copies)


def test_a_key_that_has_marked_nothing_may_be_replaced(order: Order, tmp_path: Path) -> None:
    order = replace(order, recipients=order.recipients[:1])
    assert made(replace(order, max_move=meshmark.length.read_length("1um"))).refused
    (tmp_path / "secret.key").write_text("another")
    assert made(order).made == 1
    with Ledger(order.copies / "ledger.sqlite") as ledger:
        ledger.require(meshmark.Key("another"))
        with pytest.raises(meshmark.MeshmarkError, match="another key"):
            ledger.require(meshmark.Key(KEY))


def test_copies_are_no_models_even_where_they_lie_below_them(order: Order, tmp_path: Path) -> None:
    order = replace(order, models=tmp_path, recipients=order.recipients[:1])
    assert made(order).made == 1
    body(3).export(tmp_path / "models" / ".part-of-something.stl")
    assert made(order).made == 0
    assert forecast(order, order.copies / "ledger.sqlite").copies == 0
    another = tmp_path / "out2"
    assert forecast(replace(order, copies=another), another / "ledger.sqlite").copies == 1
    with pytest.raises(meshmark.MeshmarkError, match="folder of their own"):
        forecast(replace(order, copies=tmp_path), tmp_path / "ledger.sqlite")


def test_no_file_of_another_ledger_is_replaced(order: Order, tmp_path: Path) -> None:
    order = replace(order, recipients=order.recipients[:1])
    made(order)
    before = visible(order.copies)
    for run in (make_copies, forecast):
        with pytest.raises(meshmark.MeshmarkError, match=r"not in the ledger '.*b\.sqlite'"):
            run(order, tmp_path / "b.sqlite")
    assert visible(order.copies) == before == entered(order.copies)


def test_a_ledger_has_one_folder_which_may_move(order: Order, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    order = replace(order, copies=tmp_path / "shop" / "out", recipients=order.recipients[:1])
    ledger = tmp_path / "shop" / "ledger.sqlite"

    def crash(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(ledger_module, "_bring", crash)
        with pytest.raises(KeyboardInterrupt):
            make_copies(order, ledger, scheduler=SCHEDULER)
    elsewhere = replace(order, copies=tmp_path / "elsewhere")
    for run in (make_copies, forecast):
        with pytest.raises(meshmark.MeshmarkError, match=f"are in '{order.copies}'"):
            run(elsewhere, ledger)
    for source, target in (("shop", "moved together"), ("moved together/out", "moved alone")):
        (tmp_path / source).rename(tmp_path / target)
        ledger = tmp_path / "moved together" / "ledger.sqlite"
        order = replace(order, copies=tmp_path / target / "out" if target.endswith("together") else tmp_path / target)
        outcome = make_copies(order, ledger)
        assert (outcome.made, outcome.before) == (0, 1)
        assert len(visible(order.copies)) == 1


def test_a_ledger_is_written_by_one_run_at_a_time(order: Order, tmp_path: Path) -> None:
    order = replace(order, recipients=order.recipients[:1])
    said = []

    def another(*_: object) -> None:
        with pytest.raises(meshmark.MeshmarkError, match="Another run") as error:
            make_copies(replace(order, copies=tmp_path / "elsewhere"), order.copies / "ledger.sqlite")
        said.append(error)

    assert made(order, tick=another).made == 1
    assert len(said) == 2


def test_a_fault_of_the_machine_is_no_refusal(order: Order, monkeypatch: pytest.MonkeyPatch) -> None:
    order = replace(order, recipients=order.recipients[:1])

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def narrow(*_: object, **__: object) -> None:
        raise meshmark.Failed("Not enough memory.")

    for place, name, fault, words in [
        (Path, "replace", full, "No space left"),
        (work.marking, "embed", narrow, "Not enough memory"),
        (os, "fsync", full, "No space left"),
        (run_module, "make", full, "No space left"),
        (work, "_check", lambda *_: "", "another key"),
    ]:
        with monkeypatch.context() as patch:
            patch.setattr(place, name, fault)
            outcome = made(order)
        assert (outcome.made, outcome.refused, list(outcome.failed)) == (0, {}, ["body0.stl for Jane Doe"])
        assert words in outcome.failed["body0.stl for Jane Doe"]
    source = order.models / "body0.stl"
    text = source.read_bytes()
    outcome = made(order, tick=lambda *_: source.unlink(missing_ok=True))
    assert (outcome.made, outcome.refused, len(outcome.failed)) == (0, {}, 1)
    source.write_bytes(text)
    outcome = made(order)
    assert (outcome.made, outcome.refused, outcome.failed) == (1, {}, {})


def test_exit_code_and_words_of_what_failed(
    order: Order, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    outcome = Outcome(made=1, failed={"body0.stl for Bob": "No space left on device"})
    monkeypatch.setattr(catalog_command, "make_copies", lambda *_, **__: outcome)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["meshmark", "catalog", "models", "who.csv", "out", "--key-file", "secret.key"])
    with pytest.raises(SystemExit) as left:
        main()
    said = capsys.readouterr()
    assert left.value.code == 1
    assert "failed: body0.stl for Bob: No space left on device" in said.err
    assert "1 failed" in said.out


def test_a_refusal_of_what_is_not_ordered_any_more_is_not_told(order: Order) -> None:
    outcome = made(replace(order, max_move=meshmark.length.read_length("1um")))
    assert len(outcome.refused) == 2
    assert list(made(replace(order, recipients=order.recipients[:1])).refused) == ["body0.stl for Jane Doe"]
    body(5).export(order.models / "body0.stl")
    outcome = made(replace(order, recipients=order.recipients[:1]))
    assert (outcome.made, outcome.refused) == (1, {})


def test_a_ledger_is_read_where_it_cannot_be_written(tmp_path: Path) -> None:
    path = tmp_path / "ledger.sqlite"
    with Ledger(path, "write") as ledger:
        ledger.add_recipients(["Jane"])
    tmp_path.chmod(0o555)
    path.chmod(0o444)
    program = """
import sys
from pathlib import Path
from meshmark import MeshmarkError
from meshmark.catalog import Ledger
with Ledger(Path(sys.argv[1])) as ledger:
    print(ledger.name(1))
try:
    Ledger(Path(sys.argv[1]), "write")
except MeshmarkError as error:
    print(error)
"""
    bound = ["setpriv", "--bounding-set=-all", "--inh-caps=-all"] if os.geteuid() == 0 else []  # as a user is
    said = subprocess.check_output([*bound, sys.executable, "-c", program, path], text=True)
    assert said.startswith("Jane\n")
    assert "can be written" in said
    assert "no ledger" not in said


def test_a_ledger_that_is_busy_is_read_and_says_so_to_a_writer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "ledger.sqlite"
    with Ledger(path, "write") as ledger:
        ledger.add_recipients(["Jane"])
    connect = sqlite3.connect
    monkeypatch.setattr(sqlite3, "connect", lambda *names, **options: connect(*names, **options, timeout=0))
    with closing(connect(path, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        with Ledger(path) as ledger:
            assert ledger.name(1) == "Jane"
        with pytest.raises(meshmark.MeshmarkError, match="Another program is at work in it"):
            Ledger(path, "write")
    path.write_text("no database")
    with pytest.raises(meshmark.MeshmarkError, match="is no ledger"):
        Ledger(path)


def test_another_key_is_refused(order: Order, tmp_path: Path) -> None:
    made(replace(order, recipients=order.recipients[:1]))
    (tmp_path / "another.key").write_text("another")
    with pytest.raises(meshmark.MeshmarkError, match="another key"):
        made(replace(order, key=meshmark.Key(f"file:{tmp_path / 'another.key'}")))
    with pytest.raises(meshmark.MeshmarkError, match="file or in an environment variable"):
        made(replace(order, key=meshmark.Key("a passphrase")))


def test_a_model_that_changed_gets_new_copies_beside_the_old_ones(order: Order) -> None:
    made(order)
    old = visible(order.copies)
    body(5).export(order.models / "body0.stl")
    assert made(order).made == 2
    new = visible(order.copies)
    assert old.items() <= new.items()
    assert {Path(name).name for name in new.keys() - old.keys()} == {"body0-2.stl"}
    assert new == entered(order.copies)


def test_what_moves_too_much_is_refused_and_tried_again_when_told(order: Order) -> None:
    outcome = made(replace(order, max_move=meshmark.length.read_length("1um")))
    assert (outcome.made, len(outcome.refused)) == (0, 2)
    assert all("are allowed" in reason for reason in outcome.refused.values())
    assert visible(order.copies) == {}
    assert (made(order).made, made(order, retry=True).made) == (0, 2)


def test_a_model_that_refuses_a_method_gets_the_next(order: Order) -> None:
    """A body of a cube's symmetry has no axes for Waves, and a ball no norms for L-M either."""
    ball = trimesh.creation.icosphere(4)
    ball.export(order.models / "round.stl")
    ball.apply_transform(trimesh.transformations.rotation_matrix(1, [1, 2, 3]))
    ball.vertices *= 1 + 0.2 * (ball.vertices**4).sum(axis=1, keepdims=True)
    ball.export(order.models / "even.stl")
    order = replace(order, recipients=order.recipients[:1], settings=Settings(method="Waves"), otherwise=("L-M",))
    outcome = made(order)
    assert outcome.made == 2
    (reason,) = outcome.refused.values()
    assert "Waves: " in reason
    assert "L-M: " in reason
    with Ledger(order.copies / "ledger.sqlite") as ledger:
        copies = ledger.copies()
    methods = {Path(copy.file).name: copy.recipe.method for copy in copies}
    assert methods == {"body0.stl": "Waves", "even.stl": "L-M"}
    even = next(copy for copy in copies if copy.file.endswith("even.stl"))
    assert meshmark.detect(order.copies / even.file, key=order.key, **even.recipe.values()).verified


def test_one_broken_model_does_not_stop_the_others(order: Order) -> None:
    (order.models / "broken.stl").write_bytes(b"nothing")
    outcome = made(order)
    assert outcome.made == 2
    assert list(outcome.broken) == ["broken.stl"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("recipient\nJane\nJane\n Bob \n\n", {"Jane": (), "Bob": ()}),
        ("number,recipient\n1,Jane\n", {"Jane": ()}),
        ("Email, Recipient \nj@x.org,Jane\n", {"Jane": ()}),
        ("recipient;model;\nJane;a,b.stl;\nBob;;\n;;\n", {"Jane": ("a,b.stl",), "Bob": ()}),
        ("Model\tRECIPIENT\r\na.stl\tJane\r\n", {"Jane": ("a.stl",)}),
        ("recipient,model\nJane,a.stl\nJane,b*.stl\nBob,\n", {"Jane": ("a.stl", "b*.stl"), "Bob": ()}),
        ('\ufeffrecipient,model\n"Doe, Jane",a.stl\n"Doe, Jane",\n', {"Doe, Jane": ()}),
    ],
)
def test_csv(tmp_path: Path, text: str, expected: dict) -> None:
    (tmp_path / "who.csv").write_text(text, encoding="utf-8")
    assert {one.name: one.models for one in read_recipients(tmp_path / "who.csv")} == expected


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Jane Doe\nBob\n", "no column 'recipient', but 'Jane Doe'"),
        ("name;x\nJane\n", "no column 'recipient', but 'name', 'x'"),
        ("model,recipient\na.stl,Jane\n\nfandisk.off,\n", "Line 4 of .* names no recipient"),
        ("recipient\nJane\nDoe, Bob\n", "Line 3 of .* more cells than columns"),
    ],
)
def test_csv_is_not_guessed_at(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "who.csv").write_text(text)
    with pytest.raises(meshmark.MeshmarkError, match=words):
        read_recipients(tmp_path / "who.csv")


def test_a_model_that_somebody_is_to_get_has_to_be_there(order: Order) -> None:
    """A broken one is."""
    (order.models / "broken.stl").write_bytes(b"nothing")
    with pytest.raises(meshmark.MeshmarkError, match=r"fits 'fan\*.off', which"):
        made(replace(order, recipients=[Recipient("Jane", ("body0.stl", "fan*.off"))]))
    outcome = made(replace(order, recipients=[Recipient("Jane", ("broken.stl",))]))
    assert (outcome.made, list(outcome.broken)) == (0, ["broken.stl"])
    assert fits("a[1].stl", "a[1].stl")
    assert fits("Å.stl", "A\u030a.*")


def test_csv_that_names_nobody(tmp_path: Path) -> None:
    for text in ("", "recipient\n", "recipient\n\n \n"):
        (tmp_path / "who.csv").write_text(text)
        with pytest.raises(meshmark.MeshmarkError, match="names nobody"):
            read_recipients(tmp_path / "who.csv")
    (tmp_path / "who.csv").write_bytes(b"recipient\n\xff\xfe\n")
    with pytest.raises(meshmark.MeshmarkError, match="UTF-8"):
        read_recipients(tmp_path / "who.csv")
