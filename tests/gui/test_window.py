# SPDX-License-Identifier: GPL-3.0-or-later
"""A person's way: find the filter by search in MeshLab's window, fill its dialog, apply, read log and report.

Every step waits for its condition, with a limit, and leaves a picture in build/gui.
"""

import json
import os
import re
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

import pytest
from doors import BUILD, DETECT, EMBED, FILTERS, MESHES

KEY = "correct horse battery staple"
MESSAGE = "(c) 2026"
PICTURES = BUILD / "gui"
T = TypeVar("T")


def wait_for(what: str, condition: Callable[[], T], limit: float = 60) -> T:
    """The first true answer of `condition`; fails after `limit` seconds."""
    end = time.monotonic() + limit
    while time.monotonic() < end:
        if answer := condition():
            return answer
        time.sleep(0.1)
    pytest.fail(f"waited {limit} s for {what}")


def xdotool(*arguments: str) -> str:
    return subprocess.run(["xdotool", *arguments], text=True, capture_output=True, check=False).stdout.strip()


class Window:
    """MeshLab with one mesh open."""

    def __init__(self, mesh: Path, folder: Path) -> None:
        self.log_path = folder / "meshlab.log"
        self.pictures = 0
        with self.log_path.open("w") as log:
            self.program = subprocess.Popen(
                [str(BUILD / "stage" / "bin" / "meshlab"), str(mesh)],
                env={**os.environ, "HOME": str(folder)},
                stdout=log,
                stderr=subprocess.STDOUT,
            )
        wait_for("the mesh", lambda: "All files opened" in self.log())
        wait_for("the window", lambda: self.find("^MeshLab 20"))

    def log(self) -> str:
        return self.log_path.read_text(encoding="utf-8", errors="replace")

    def find(self, title: str) -> str:
        return xdotool("search", "--onlyvisible", "--name", title)

    def focus(self, title: str) -> None:
        """Gives a window the keys, for good: as a dialog closes, others vanish for a moment and the focus moves."""

        def has_it() -> bool:
            time.sleep(0.2)
            return xdotool("getwindowfocus") in self.find(title).split()

        def rests() -> bool:
            if has_it() and has_it():
                return True
            for window in self.find(title).split():
                xdotool("windowactivate", window, "windowfocus", window)
            return False

        wait_for(f"the focus on {title}", rests)

    def windows(self) -> set[str]:
        return set(xdotool("search", "--onlyvisible", "--pid", str(self.program.pid)).split())

    def picture(self, step: str) -> None:
        self.pictures += 1
        path = PICTURES / f"{self.pictures:02}-{step}.png"
        subprocess.run(["import", "-window", "root", str(path)], check=True, timeout=30)

    def open_dialog(self, filter_name: str) -> None:
        """Ctrl+F, the filter's name, and the first that is offered."""
        before = self.windows()
        self.focus("^MeshLab 20")
        xdotool("key", "ctrl+f")
        search = wait_for("the search box", lambda: self.windows() - before).pop()
        xdotool("type", "--delay", "20", filter_name)

        def offered() -> bool:
            size = re.search(r"Geometry: \d+x(\d+)", xdotool("getwindowgeometry", search))
            return bool(size) and int(size[1]) > 60

        wait_for("an offer", offered)
        self.picture("search")
        xdotool("key", "Down")
        xdotool("key", "Return")
        self.focus(f"^{filter_name}$")

    def fill(self, filter_name: str, values: dict[str, str]) -> None:
        """Goes through the fields with Tab, from the dialog's title buttons to Apply."""
        has_preview = filter_name == EMBED  # a box before the fields, where a filter changes the layer
        xdotool("key", *["Tab"] * (2 if has_preview else 1))
        for name, (kind, _) in FILTERS[filter_name][1].items():
            xdotool("key", "Tab")
            if name in values and name != "Report":
                xdotool("type", "--delay", "5", values[name])
            if kind == "RichSaveFile" and name != "Report":
                xdotool("key", "Tab")  # the button beside the field
        xdotool("key", "Tab")
        if "Report" in values:
            self.choose_file(values["Report"])
            self.focus(f"^{filter_name}$")
        xdotool("key", "Tab", "Tab", "Tab")
        self.picture("filled")

    def choose_file(self, path: str) -> None:
        """By the button beside the field: MeshLab 2020.09 does not take what is typed into the field."""
        xdotool("key", "space")
        self.focus("^Save$")
        xdotool("type", "--delay", "5", path)
        xdotool("key", "Return")
        wait_for("the file dialog to close", lambda: not self.find("^Save$"))

    def apply(self) -> None:
        xdotool("key", "space")

    def close_dialog(self, filter_name: str) -> None:
        self.focus(f"^{filter_name}$")
        xdotool("key", "shift+Tab", "space")
        wait_for("the dialog to close", lambda: not self.find(f"^{filter_name}$"))


@pytest.fixture
def window(display: str, tmp_path: Path) -> Iterator[Window]:
    shutil.rmtree(PICTURES, ignore_errors=True)
    PICTURES.mkdir()
    with subprocess.Popen(["openbox"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as manager:
        opened = Window(MESHES / "bunny00.off", tmp_path)
        try:
            yield opened
        finally:
            opened.picture("end")
            print(opened.log())
            opened.program.kill()
            opened.program.wait()
            manager.terminate()


def test_embed_and_detect_by_hand(window: Window, tmp_path: Path) -> None:
    report = tmp_path / "report.json"
    window.open_dialog(EMBED)
    window.fill(EMBED, {"Message": MESSAGE, "Key": KEY, "Report": str(report)})
    window.apply()
    wait_for("the report", report.exists)
    wait_for("the log", lambda: "detection_ratio: 1" in window.log())
    window.picture("embedded")
    embedded = json.loads(report.read_text())
    assert embedded["method"] == "Layered"
    assert embedded["moved_vertices"] > 1000
    assert KEY not in window.log()
    window.close_dialog(EMBED)

    # The mesh in the window carries the mark now.
    report.unlink()
    window.open_dialog(DETECT)
    window.fill(DETECT, {"Key": KEY, "Expected": MESSAGE, "ShowCarriers": " ", "Report": str(report)})
    window.apply()
    wait_for("the report", report.exists)
    wait_for("the log", lambda: "present: true" in window.log())
    window.picture("detected")
    detected = json.loads(report.read_text())
    assert detected["message"] == MESSAGE
    assert detected["present"] is True
    window.close_dialog(DETECT)

    # An error is shown with its cure.
    window.open_dialog(EMBED)
    window.fill(EMBED, {"Message": MESSAGE})
    window.apply()
    wait_for("the message", lambda: window.find("^Filter Failure$"))
    window.picture("refused")
    assert "The key is empty. Give a passphrase" in window.log()
