"""FBX: whether it is one, and the textures that it names."""

from __future__ import annotations

from pathlib import Path

import pytest

from legorize_addon.core.files.sources.fbx import named_files
from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import refusal

TEXT = b'; FBX 7.4.0 project file\nFBXHeaderExtension: {}\nRelativeFilename: "paint.png"\n'
BINARY = b"Kaydara FBX Binary  \0\x1a\0\x10RelativeFilenameS\x09\0\0\0paint.png"


@pytest.mark.parametrize("content", [TEXT, BINARY])
def test_textures(content: bytes, tmp_path: Path) -> None:
    """A texture may be missing, or a file, and nothing else."""
    (tmp_path / "box.fbx").write_bytes(content)
    assert named_files(content) == {"paint.png"}
    assert check_source(tmp_path / "box.fbx", ()) == ()
    (tmp_path / "paint.png").mkdir()
    assert "'paint.png', which is not a file" in refusal(tmp_path / "box.fbx")


def test_length_that_lies() -> None:
    """A name whose length is beyond the file is cut at its end."""
    assert named_files(BINARY.replace(b"S\x09\0\0\0", b"S\xff\xff\xff\xff")) == {"paint.png"}


def test_longest_name() -> None:
    """No name is longer than a path of Linux, which has 4,096 bytes (PATH_MAX in limits.h)."""
    name = b"x" * 5000
    assert named_files(b"Kaydara FBX Binary  FileNameS" + (5000).to_bytes(4, "little") + name) == {"x" * 4096}
    assert named_files(b"Kaydara FBX Binary  FileNameS" + (4096).to_bytes(4, "little") + name) == {"x" * 4096}
    assert named_files(b"Kaydara FBX Binary  FileNameS" + (4095).to_bytes(4, "little") + name) == {"x" * 4095}


def test_other_content(tmp_path: Path) -> None:
    """The name alone makes no FBX file."""
    (tmp_path / "box.fbx").write_bytes(b"v 0 0 0\n")
    assert "is not an FBX file" in refusal(tmp_path / "box.fbx")
