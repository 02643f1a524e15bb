"""Paths that cannot be used are told in a sentence, whatever is wrong with them."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from legorize_addon.core.errors import BuildError, LegorizeError, MeshError, SettingsError
from legorize_addon.core.files.paths import LONGEST, named, readable, writable


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("", "has no name"),
        (" ", "has no name"),
        ("a\0b", "NUL"),
        ("caf\udce9.obj", r"caf\\udce9\.obj is not UTF-8"),
        ("x/" * 600, "longer than the 1023 bytes"),
    ],
)
def test_bad_names(path: str, words: str) -> None:
    """Each gives one sentence that can be printed, and the error that was asked for."""
    for error in (SettingsError, BuildError):
        with pytest.raises(error, match=words) as caught:
            named(path, "folder", error)
        assert str(caught.value).isprintable()
        assert str(caught.value).endswith(".")
    for use in (readable, writable):
        with pytest.raises(LegorizeError, match=words):
            use(Path(path) if path.strip() else path)


def test_longest_name_is_counted_from_the_root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A path that is one byte too long with its folders is refused; one that just fits is not."""
    monkeypatch.chdir(tmp_path)
    room = LONGEST - len(os.getcwd()) - 1
    fits = "/".join(["n" * 50] * (room // 51)) + "/" + "n" * (room % 51)
    assert len(os.path.abspath(fits)) == LONGEST
    assert named(fits, "folder") == Path(fits)
    with pytest.raises(SettingsError, match="longer"):
        named(f"{fits}n", "folder")


def test_working_folder_that_is_gone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A relative name means nothing there; an absolute one does."""
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    with pytest.raises(SettingsError, match="working folder is no longer there"):
        named("out", "folder")
    assert named(str(tmp_path / "out"), "folder") == tmp_path / "out"


def test_files_to_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file is named by its own path, a link by the link's; all else is a sentence."""
    (tmp_path / "box.obj").touch()
    (tmp_path / "link.obj").symlink_to("box.obj")
    monkeypatch.chdir(tmp_path)
    assert readable(Path("link.obj")) == Path(os.path.abspath("link.obj"))
    os.mkfifo("pipe.obj")
    for path, words in {
        "lost.obj": "There is no file lost.obj",
        "box.obj/box.obj": "There is no file",
        "pipe.obj": "a device or a pipe",
        ".": "is a folder",
        f"{'n' * 300}.obj": "cannot be read",
    }.items():
        with pytest.raises(MeshError, match=words):
            readable(Path(path))


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root may read everything")
def test_folder_that_cannot_be_searched(tmp_path: Path) -> None:
    """A file in it cannot be asked for, nor written."""
    closed = tmp_path / "closed"
    closed.mkdir()
    closed.chmod(0)
    with pytest.raises(MeshError, match="cannot be read"):
        readable(closed / "box.obj")
    with pytest.raises(BuildError, match="cannot be written"):
        writable(closed / "box.obj")
    closed.chmod(0o700)
