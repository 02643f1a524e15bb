"""Blender's own files: only whether they are some, since Blender checks the rest itself."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from ...errors import MeshError

_MAGIC: Final = (b"BLENDER", b"\x1f\x8b", b"\x28\xb5\x2f\xfd")
"""As it is, compressed by gzip (until Blender 2.93), compressed by Zstandard (since 3.0)."""


def check_blend(source: Path) -> tuple[str, ...]:
    """Refuse what is no Blender file."""
    with source.open("rb") as file:
        if not file.read(7).startswith(_MAGIC):
            raise MeshError(
                f"{source.name} is not a Blender file, although its name says so: save it again with Blender."
            )
    return ()
