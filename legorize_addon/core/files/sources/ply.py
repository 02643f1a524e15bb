"""PLY: Blender's reader believes the counts of the header, and an early end aborts it."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...errors import MeshError
from .damage import damaged
from .ply_header import LONGEST_LINE, Element, Header, Property, read_header

Bytes: TypeAlias = memoryview
Ints: TypeAlias = NDArray[np.int64]

_INDICES: Final = {
    "face": ("vertex_indices", "vertex_index"),
    "tristrips": ("vertex_indices", "vertex_index"),
    "edge": ("vertex1", "vertex2"),
}
"""Columns with numbers of vertices, by table."""

_LENGTH, _VALUE = "length", "value"
"""How the fields of a row begin, before the number of the column."""


def check_ply(source: Path) -> tuple[str, ...]:
    """Refuse a PLY file whose data are fewer than its header promises, or whose faces name vertices it lacks."""
    data = source.read_bytes()
    header = read_header(source, data)
    vertices = sum(element.count for element in header.elements if element.name == "vertex")
    check = _check_text if header.is_text else _check_binary
    check(source, memoryview(data)[header.end :], header, vertices)
    if not header.textures:
        return ()
    return (
        f"The texture {header.textures[0]!r} of {source.name} is left out, since Blender reads no textures of .ply "
        "files: export the model as .glb or .obj to keep it.",
    )


# -- binary data -------------------------------------------------------------------------------------------------------


def _check_binary(source: Path, body: Bytes, header: Header, vertices: int) -> None:
    at = 0
    for element in header.elements:
        fixed = sum(np.dtype(each.count_kind or each.kind).itemsize for each in element.properties)
        if at + fixed * element.count > len(body):
            raise _short(source, element)
        if element.count and element.properties:
            at = _check_table(source, body, at, element, vertices)


def _check_table(source: Path, body: Bytes, at: int, element: Element, vertices: int) -> int:
    """Check the rows of a table that begins at a byte; return where it ends."""
    row = _row(source, body, at, element)
    if at + element.count * row.itemsize <= len(body):
        rows = np.frombuffer(body, row, element.count, at)
        lengths = [rows[name] for name in row.names or () if name.startswith(_LENGTH)]
        if all((column == column[0]).all() for column in lengths):
            for number, each in enumerate(element.properties):
                if _is_index(element, each):
                    _check_indices(source, element, rows[f"{_VALUE}{number}"], vertices)
            return at + element.count * row.itemsize
    return _check_rows(source, body, at, element, vertices)


def _row(source: Path, body: Bytes, at: int, element: Element) -> np.dtype[np.void]:
    """Return the layout of the row at a byte."""
    columns: list[tuple[str, str] | tuple[str, str, int]] = []
    for number, each in enumerate(element.properties):
        if not each.count_kind:
            columns.append((f"{_VALUE}{number}", each.kind))
            continue
        place = at + np.dtype(columns).itemsize
        length = _length(source, body, place, element, each)
        columns += [(f"{_LENGTH}{number}", each.count_kind), (f"{_VALUE}{number}", each.kind, length)]
    return np.dtype(columns)


def _length(source: Path, body: Bytes, at: int, element: Element, listed: Property) -> int:
    """Return the length of a list that begins at a byte, which has to fit into the file."""
    if at + np.dtype(listed.count_kind).itemsize > len(body):
        raise _short(source, element)
    length = int(np.frombuffer(body, listed.count_kind, 1, at)[0])
    if length < 0 or length * np.dtype(listed.kind).itemsize > len(body):
        raise damaged(source, f"a list in its table {element.name!r} has the length {length}")
    return length


def _check_rows(source: Path, body: Bytes, at: int, element: Element, vertices: int) -> int:
    """Check a table with lists of different lengths, row by row, and then the indices of lists of equal length."""
    starts: dict[int, list[int]] = {
        number: [] for number, each in enumerate(element.properties) if _is_index(element, each)
    }
    lengths: dict[int, list[int]] = {number: [] for number in starts}
    readers = [
        (number, struct.Struct(_struct(each.count_kind)) if each.count_kind else None, np.dtype(each.kind).itemsize)
        for number, each in enumerate(element.properties)
    ]
    try:
        for _ in range(element.count):
            for number, reader, size in readers:
                length = 1
                if reader is not None:
                    (length,) = reader.unpack_from(body, at)
                    at += reader.size
                if number in starts:
                    starts[number].append(at)
                    lengths[number].append(length)
                at += length * size
    except struct.error as error:
        raise _short(source, element) from error
    if at > len(body):
        raise _short(source, element)
    for number in starts:
        kind = np.dtype(element.properties[number].kind)
        for values in _equal_lists(body, np.array(starts[number]), np.array(lengths[number]), kind):
            _check_indices(source, element, values, vertices)
    return at


def _equal_lists(body: Bytes, starts: Ints, lengths: Ints, kind: np.dtype[Any]) -> Iterator[NDArray[Any]]:
    """Yield the values of lists, many at once: a corner of all lists of equal length, or all corners of one list."""
    for length in np.unique(lengths).tolist():
        rows = starts[lengths == length]
        if len(rows) < length:
            yield from (np.frombuffer(body, kind, length, row) for row in rows.tolist())
            continue
        for corner in range(length):
            places = rows[:, None] + (corner * kind.itemsize + np.arange(kind.itemsize))
            yield np.frombuffer(body, np.uint8)[places].view(kind)


def _struct(kind: str) -> str:
    return kind[0] + {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I"}[kind[1:]]


# -- data as text ------------------------------------------------------------------------------------------------------


def _check_text(source: Path, body: Bytes, header: Header, vertices: int) -> None:
    lines = [line for line in bytes(body).splitlines() if line.strip()]
    if max(map(len, lines), default=0) >= LONGEST_LINE:
        raise damaged(source, f"a line is longer than {LONGEST_LINE} bytes")
    at = 0
    for element in header.elements:
        rows = lines[at : at + element.count]
        at += element.count
        if len(rows) < element.count:
            raise _short(source, element)
        if any(_is_index(element, each) for each in element.properties):
            _check_indices(source, element, _numbers(source, element, rows), vertices)


def _numbers(source: Path, element: Element, rows: list[bytes]) -> Ints:
    """Return the indices of vertices in the rows of a table."""
    found: list[bytes] = []
    columns = [(each, _is_index(element, each)) for each in element.properties]
    for row in rows:
        words, at = row.split(), 0
        for each, is_index in columns:
            length = 1
            if each.count_kind:
                length = int(words[at]) if at < len(words) and words[at].isdigit() else len(words)
                at += 1
            if is_index:
                found += words[at : at + length]
            at += length
        if at > len(words):
            raise damaged(source, f"its table {element.name!r} has the line {row[:80].decode(errors='replace')!r}")
    try:
        return np.array(list(map(int, found)), dtype=np.int64)
    except (ValueError, OverflowError) as error:
        raise damaged(source, f"its table {element.name!r} has an index that is not a whole number") from error


# -- both --------------------------------------------------------------------------------------------------------------


def _is_index(element: Element, each: Property) -> bool:
    """Return whether a column holds numbers of vertices: by its name, or as the only list of a face."""
    lists = [each for each in element.properties if each.count_kind]
    named = each.name in _INDICES.get(element.name, ())
    return each.kind[-2] != "f" and (named or (element.name == "face" and lists == [each]))


def _check_indices(source: Path, element: Element, indices: NDArray[Any], vertices: int) -> None:
    least = -1 if element.name == "tristrips" else 0
    if indices.size and not (least <= indices.min() and indices.max() < vertices):
        wrong = int(indices.max()) if indices.max() >= vertices else int(indices.min())
        raise damaged(
            source, f"its table {element.name!r} names vertex {wrong}, but there are {vertices}, counted from 0"
        )


def _short(source: Path, element: Element) -> MeshError:
    return damaged(source, f"its header says {element.count} rows of {element.name!r}, but fewer follow")
