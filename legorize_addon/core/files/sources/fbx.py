"""FBX: only the kind and the files it names, since the importer checks the rest itself."""

from __future__ import annotations

import mmap
import re
from pathlib import Path
from typing import Final

from ...errors import MeshError
from .references import check_regular

_BINARY: Final = b"Kaydara FBX Binary"
_TEXT: Final = re.compile(rb"FBXHeaderExtension|^\s*;\s*FBX", re.MULTILINE)
_NAMED: Final = re.compile(rb"(?:Relative)?File[Nn]ame(?:S(.{4})|:\s*\"([^\"\r\n]*)\")", re.DOTALL)
_LONGEST: Final = 4096
"""Bytes of a path, the limit of Linux."""


def check_fbx(source: Path) -> tuple[str, ...]:
    """Refuse what is no FBX file, and one whose textures are no files."""
    with source.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        start = data[:4096]
        if not start.startswith(_BINARY) and not _TEXT.search(start):
            raise MeshError(f"{source.name} is not an FBX file, although its name says so: export it again.")
        names = named_files(data)
    check_regular(source, names)
    return ()


def named_files(data: bytes | mmap.mmap) -> set[str]:
    """Return the names of files in an FBX file, binary or text."""
    names = set()
    for match in _NAMED.finditer(data):
        if match[1] is None:
            name = match[2]
        else:
            name = data[match.end() : match.end() + min(int.from_bytes(match[1], "little"), _LONGEST)]
        names.add(name.decode(errors="replace"))
    return names - {""}
