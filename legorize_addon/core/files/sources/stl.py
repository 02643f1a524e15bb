"""STL: Blender takes one whose length is not that of its count for text, and finds nothing in it."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Final

from .damage import damaged

_HEADER: Final = 84
_TRIANGLE: Final = 50
"""Bytes of the header with its count, and of a triangle."""


def check_stl(source: Path) -> tuple[str, ...]:
    """Refuse an STL file that ends early, or whose count of triangles is wrong."""
    size = source.stat().st_size
    with source.open("rb") as file:
        head = file.read(1024)
        file.seek(max(size - 1024, 0))
        tail = file.read().lower()
    if size >= _HEADER:
        (count,) = struct.unpack_from("<I", head, 80)
        if size == _HEADER + _TRIANGLE * count:
            return ()
    if not head.lstrip().lower().startswith(b"solid") or b"\0" in head:
        if size < _HEADER:
            raise damaged(source, "its header is incomplete")
        whole = (size - _HEADER) // _TRIANGLE
        raise damaged(source, f"its header says {count} triangles, but {whole} whole ones follow")
    if tail.rfind(b"facet normal") > tail.rfind(b"endfacet"):
        raise damaged(source, "it ends within a facet")
    return ()
