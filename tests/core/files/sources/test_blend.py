"""Blender's own files: whether they are some, and what they link to."""

from __future__ import annotations

import gzip
import os
from pathlib import Path

import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.core.files.sources.blend import check_blend
from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import refusal


@pytest.mark.parametrize("start", [b"BLENDER-v405", b"BLENDER17-01v0502", b"\x1f\x8b\x08", b"\x28\xb5\x2f\xfd"])
def test_kinds_of_blend_files(start: bytes, tmp_path: Path) -> None:
    """Old and new headers, and both compressions."""
    (tmp_path / "scene.blend").write_bytes(start + bytes(100))
    assert check_source(tmp_path / "scene.blend", ()) == ()


def test_other_content(tmp_path: Path) -> None:
    """The name alone makes no Blender file."""
    (tmp_path / "scene.blend").write_bytes(b"PK\x03\x04" + bytes(100))
    assert "is not a Blender file" in refusal(tmp_path / "scene.blend")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes")
@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize("absolute", [False, True])
def test_linked_pipe(compressed: bool, absolute: bool, tmp_path: Path) -> None:
    """Blender would wait for ever for what a pipe in the place of a linked file says."""
    library = tmp_path / "lib.blend"
    name = os.fsencode(library) if absolute else b"//lib.blend"
    content = b"BLENDER17-01v0500" + b"\0" * 3000 + name + b"\0" * 3000
    path = tmp_path / "a.blend"
    path.write_bytes(gzip.compress(content) if compressed else content)
    assert check_blend(path) == ()
    library.write_bytes(b"a file")
    assert check_blend(path) == ()
    library.unlink()
    os.mkfifo(library)
    with pytest.raises(MeshError, match=r"lib\.blend', which is not a file"):
        check_blend(path)


def test_damaged_compressed_file_is_left_to_blender(tmp_path: Path) -> None:
    """What cannot be unpacked has no links that could be looked at."""
    path = tmp_path / "a.blend"
    path.write_bytes(gzip.compress(b"BLENDER" + bytes(range(256)) * 100)[:-20])
    assert check_blend(path) == ()
