"""A file is there as a whole or as it was; links are followed, devices left alone, rights as the user's files have."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path

import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.files.single import replacing, write_whole

POSIX = pytest.mark.skipif(os.name != "posix", reason="rights, links and devices as POSIX has them")


@pytest.fixture(params=[0o022, 0o077, 0o002])
def mask(request: pytest.FixtureRequest) -> Iterator[int]:
    """Set what the user takes away from the rights of new files."""
    before = os.umask(request.param)
    yield request.param
    os.umask(before)


def names(folder: Path) -> list[str]:
    """Return what lies in a folder."""
    return sorted(entry.name for entry in folder.iterdir())


def test_text_keeps_its_letters(tmp_path: Path) -> None:
    """A file keeps its line ends and its letters, and takes the place of an older one."""
    path = tmp_path / "text.txt"
    write_whole(path, "old")
    write_whole(path, "grün\r\n")
    assert path.read_bytes() == "grün\r\n".encode()
    assert names(tmp_path) == ["text.txt"]


@POSIX
def test_rights_are_the_users(tmp_path: Path, mask: int) -> None:
    """A new file has the usual rights; one that is replaced keeps its own."""
    path = tmp_path / "model.ldr"
    write_whole(path, "new")
    assert stat.S_IMODE(path.stat().st_mode) == 0o666 & ~mask
    path.chmod(0o640)
    write_whole(path, "newer")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


@POSIX
def test_links_are_followed(tmp_path: Path) -> None:
    """What a link points to is written, near or far, there or not yet; the link stays."""
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "there.ldr").write_text("old")
    for name in ("there.ldr", "new.ldr"):
        (tmp_path / f"link-{name}").symlink_to(Path("far", name))
        write_whole(tmp_path / f"link-{name}", "bricks")
        assert (tmp_path / f"link-{name}").is_symlink()
    assert names(tmp_path / "far") == ["new.ldr", "there.ldr"]
    assert {path.read_text() for path in (tmp_path / "far").iterdir()} == {"bricks"}
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(BuildError, match="cannot be written"):
        write_whole(tmp_path / "loop", "bricks")


@POSIX
def test_devices_are_left_alone(tmp_path: Path) -> None:
    """Neither a device nor a pipe is replaced by a file."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to("pipe")
    for path in (Path(os.devnull), tmp_path / "pipe", tmp_path / "link"):
        with pytest.raises(BuildError, match="a device, a pipe or a socket"):
            write_whole(path, "bricks")
    assert stat.S_ISCHR(os.stat(os.devnull).st_mode)
    assert stat.S_ISFIFO((tmp_path / "pipe").stat().st_mode)
    assert names(tmp_path) == ["link", "pipe"]


def test_failure_leaves_the_old_file(tmp_path: Path) -> None:
    """What goes wrong half way, a stop included, leaves the file as it was and nothing beside it."""
    path = tmp_path / "model.ldr"
    write_whole(path, "old")
    for error in (BuildError, KeyboardInterrupt):
        with pytest.raises(error), replacing(path) as partial:  # noqa: PT012 - half of it is written
            partial.write_text("half")
            raise error
    assert path.read_text() == "old"
    assert names(tmp_path) == ["model.ldr"]


def test_what_a_killed_program_left_is_taken_up(tmp_path: Path) -> None:
    """The next one that writes the same file clears what the one before left."""
    with replacing(tmp_path / "model.ldr") as partial:
        left = partial
    left.write_text("half")
    write_whole(tmp_path / "model.ldr", "whole")
    assert names(tmp_path) == ["model.ldr"]


def test_longest_name_can_be_written(tmp_path: Path) -> None:
    """The name beside it is not longer than the file's own."""
    path = tmp_path / f"{'n' * 251}.ldr"
    write_whole(path, "bricks")
    assert path.read_text() == "bricks"


@pytest.mark.parametrize("place", ["nowhere/model.ldr", "file/model.ldr", "folder", f"{'n' * 300}.ldr"])
def test_bad_places_are_sentences(tmp_path: Path, place: str) -> None:
    """A folder that is not there, a file as a folder, a folder as a file, a name that is too long."""
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").touch()
    with pytest.raises(BuildError, match=r"^The file .* cannot be written \(.+\): choose another place\.$"):
        write_whole(tmp_path / place, "bricks")
    assert names(tmp_path) == ["file", "folder"]
