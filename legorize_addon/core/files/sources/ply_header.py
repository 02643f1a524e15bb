"""The header of a PLY file: its tables and their columns."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from .damage import damaged

_TYPES: Final = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"),
    **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"),
    **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"),
    **dict.fromkeys(("double", "float64"), "f8"),
}
_ORDERS: Final = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
LONGEST_LINE: Final = 1 << 16
"""Bytes of a line: Blender's buffer, which ends the program if a line is longer."""

_MOST: Final = 2**31 - 1
"""Elements of a kind, and the largest index: Blender counts them with an int."""


@dataclass(frozen=True, slots=True)
class Property:
    """A value of each element, or a list of values.

    Attributes
    ----------
    name : str
        As in the file.
    kind : str
        numpy's name of the value's type, with the byte order.
    count_kind : str
        That of a list's length; empty for a single value.
    """

    name: str
    kind: str
    count_kind: str = ""


@dataclass(frozen=True, slots=True)
class Element:
    """A table of the file: its name, number of rows, and columns."""

    name: str
    count: int
    properties: list[Property] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Header:
    """What a header says, and where its data begin.

    Attributes
    ----------
    is_text : bool
        Whether the data are text.
    elements : list of Element
        In their order.
    textures : list of str
        Names of images in comments.
    end : int
        Byte at which the data begin.
    """

    is_text: bool
    elements: list[Element]
    textures: list[str]
    end: int


def read_header(source: Path, data: bytes) -> Header:
    """Read the header of a PLY file.

    Raises
    ------
    MeshError
        If it is none, or has no end.
    """
    found = re.search(rb"^end_header[ \t]*\r?\n", data[:LONGEST_LINE], re.MULTILINE)
    if data[:3] != b"ply" or found is None:
        reason = "its header has no end" if data[:3] == b"ply" else "it does not begin with the word ply"
        raise damaged(source, reason)
    lines = [line.decode(errors="replace").split() for line in data[: found.start()].splitlines()]
    order = next((_ORDERS.get(words[1]) for words in lines if words[:1] == ["format"] and len(words) > 1), None)
    if order is None:
        raise damaged(source, "its header names no known format")
    elements: list[Element] = []
    for words in lines:
        try:
            _take(words, elements, order)
        except (IndexError, KeyError, ValueError) as error:
            raise damaged(source, f"its header has the line {' '.join(words)[:80]!r}") from error
    textures = [" ".join(words[2:]) for words in lines if words[:2] == ["comment", "TextureFile"] and len(words) > 2]
    return Header(is_text=not order, elements=elements, textures=textures, end=found.end())


def _take(words: list[str], elements: list[Element], order: str) -> None:
    """Add the element or property of a line of the header."""
    if words[:1] == ["element"]:
        count = int(words[2])
        if not 0 <= count <= _MOST:
            raise ValueError(count)
        elements.append(Element(words[1], count))
    elif words[:2] == ["property", "list"]:
        length = _TYPES[words[2]]
        if length[0] == "f":
            raise ValueError(length)
        elements[-1].properties.append(Property(words[4], order + _TYPES[words[3]], order + length))
    elif words[:1] == ["property"]:
        elements[-1].properties.append(Property(words[2], order + _TYPES[words[1]]))
