"""Blender's own files: whether they are some."""

from __future__ import annotations

from pathlib import Path

import pytest

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
