"""Wavefront OBJ: its material libraries, and the textures that they name."""

from __future__ import annotations

import mmap
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from ...errors import MeshError
from .references import beside, check_regular, is_missing

_LIBRARY: Final = re.compile(rb"^[ \t]*mtllib[ \t]+([^\r\n]*)", re.MULTILINE)
_USED: Final = re.compile(rb"^[ \t]*usemtl[ \t]+([^\r\n]*)", re.MULTILINE)
_DEFINED: Final = re.compile(rb"^[ \t]*newmtl[ \t]+([^\r\n]*)", re.MULTILINE)
_MAP: Final = re.compile(rb"^[ \t]*(?:map_\w+|norm|bump|refl|disp|decal)[ \t]+([^\r\n]*)", re.MULTILINE | re.IGNORECASE)
_NAMES: Final = 3
"""Names of materials that a remark lists."""


def check_obj(source: Path) -> tuple[str, ...]:
    """Refuse what is no text or names textures that are no files; tell which materials are not there."""
    with source.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        if b"\0" in data[:4096]:
            raise MeshError(f"{source.name} is not text in UTF-8, as an .obj file must be: export it again.")
        libraries = list(dict.fromkeys(_names(_LIBRARY, data)))
        used = set(_names(_USED, data))
    # Blender looks into a library that has the name of the model, too
    own = source.with_suffix(".mtl").name
    check_regular(source, [*libraries, own])
    lost = [name for name in libraries if is_missing(source, name)]
    texts = [_text(source, name) for name in dict.fromkeys([*libraries, own]) if not is_missing(source, name)]
    for text in texts:
        check_regular(source, (name.split()[-1] for name in _names(_MAP, text) if name))
    undefined = sorted(used - {name for text in texts for name in _names(_DEFINED, text)})
    return tuple(_remarks(source, lost, undefined, found=bool(texts)))


def _remarks(source: Path, lost: list[str], undefined: list[str], *, found: bool) -> Iterator[str]:
    """Yield what the user has to know of materials that are not there; unused libraries are none of it."""
    if not undefined:
        return
    shown = ", ".join(undefined[:_NAMES]) + (" and others" if len(undefined) > _NAMES else "")
    if lost:
        files = ", ".join(lost)
        yield f"The material file {files} is missing, so {shown} have no colours: put it beside {source.name}."
    elif found:
        yield f"The materials {shown} are in no material file of {source.name}: their faces are white."
    else:
        yield f"{source.name} names no material file, so its materials {shown} are white: add an mtllib line."


def _text(source: Path, name: str) -> bytes:
    path = beside(source, name)
    assert path is not None
    return path.read_bytes()


def _names(pattern: re.Pattern[bytes], data: bytes | mmap.mmap) -> list[str]:
    found = (match[1].decode(errors="replace").strip() for match in pattern.finditer(data))
    return [name[1:-1] if len(name) > 2 and name[0] == name[-1] == '"' else name for name in found]
