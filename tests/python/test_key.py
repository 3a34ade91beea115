# SPDX-License-Identifier: GPL-3.0-or-later
"""The key's check tells two keys apart exactly where the plugin does."""

import unicodedata
from pathlib import Path

import meshmark
import pytest
from bodies import body
from meshmark.key import Key

SECRET = "Schlüssel"
SALT = b"salt"


@pytest.fixture(scope="module")
def marked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model with a mark of the secret."""
    folder = tmp_path_factory.mktemp("key")
    body(0).export(folder / "model.stl")
    meshmark.embed(folder / "model.stl", folder / "marked.stl", message="id:1", key=SECRET, method="L-M")
    return folder / "marked.stl"


def same_to_both(marked: Path, key: str) -> bool:
    """Whether it is the secret, to the plugin and to the check, which have to agree."""
    plugin = meshmark.detect(marked, key=key, method="L-M").verified
    assert plugin is (Key(key).check(SALT) == Key(SECRET).check(SALT))
    return plugin


@pytest.mark.parametrize(("end", "same"), [("", True), ("\n", True), ("\r\n", True), ("\n\n", False), (" ", False)])
def test_a_key_file_counts_without_the_end_of_its_last_line(tmp_path: Path, marked: Path, end: str, same: bool) -> None:
    (tmp_path / "key").write_bytes((SECRET + end).encode())
    assert same_to_both(marked, f"file:{tmp_path / 'key'}") is same


@pytest.mark.parametrize(
    ("value", "same"),
    [(b"Schl\xc3\xbcssel", True), (b"Schlu\xcc\x88ssel", False), (b"Schl\xc3\xbcssel\n", False), (b"\xff", False)],
)
def test_a_variable_counts_as_it_is(marked: Path, monkeypatch: pytest.MonkeyPatch, value: bytes, same: bool) -> None:
    monkeypatch.setenv("KEY_TEST", value.decode(errors="surrogateescape"))
    assert same_to_both(marked, "env:KEY_TEST") is same


def test_a_passphrase_is_the_same_however_it_is_spelled_and_may_be_a_word_of_ours() -> None:
    checks = {Key(unicodedata.normalize(form, "Schlüssel")).check(SALT) for form in ("NFC", "NFD")}
    assert len(checks) == 1
    assert len({Key(word).check(SALT) for word in ("file", "env")}) == 2


def test_what_is_empty_or_missing_is_no_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("KEY_TEST", "")
    for text in ("", "\n", "\r\n"):
        (tmp_path / "key").write_bytes(text.encode())
        with pytest.raises(meshmark.MeshmarkError, match="is empty"):
            Key(f"file:{tmp_path / 'key'}").check(SALT)
    for key in ("env:KEY_TEST", "env:NO_SUCH_VARIABLE"):
        with pytest.raises(meshmark.MeshmarkError, match="is not set"):
            Key(key).check(SALT)
    with pytest.raises(meshmark.MeshmarkError, match="cannot be read"):
        Key("file:/no/such/file").check(SALT)
