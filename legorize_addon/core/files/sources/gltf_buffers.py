"""The buffers of a glTF file, and the addresses of the files that it needs."""

from __future__ import annotations

import base64
import binascii
import posixpath
import re
from pathlib import Path
from typing import Any, Final, TypeAlias
from urllib.parse import unquote

from ...errors import MeshError
from .damage import damaged
from .references import beside, check_regular, is_missing

Json: TypeAlias = dict[str, Any]

_SCHEME: Final = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
"""Of an address such as http:, or a drive of Windows."""


def buffers(source: Path, document: Json, binary: memoryview | None) -> list[memoryview | None]:
    """Return the buffers of a glTF file, None for one whose data are nowhere.

    Raises
    ------
    MeshError
        If an address leads out of the file's folder, or a buffer is missing or shorter than it says.
    """
    addresses = [part.get("uri") for table in ("buffers", "images") for part in document.get(table, [])]
    files = [_file_name(source, address) for address in addresses if address is not None and not _is_inside(address)]
    check_regular(source, files)
    rows = document.get("buffers", [])
    found = [_buffer(source, row, binary if number == 0 else None) for number, row in enumerate(rows)]
    for number, (row, data) in enumerate(zip(rows, found, strict=True)):
        length = row.get("byteLength")
        if data is not None and isinstance(length, int) and length > len(data):
            raise damaged(source, f"buffers/{number} should have {length} bytes, but there are {len(data)}")
    return found


def _is_inside(address: Any) -> bool:
    return isinstance(address, str) and address.startswith("data:")


def _file_name(source: Path, address: Any) -> str:
    """Return the name of a file from its address, which has to be in the folder of the glTF file."""
    if not isinstance(address, str):
        raise damaged(source, f"the address {address!r} is not text")
    name = posixpath.normpath(unquote(address).replace("\\", "/"))
    if _SCHEME.match(address) or name.startswith(("/", "../")) or name == ".." or "\0" in name:
        raise MeshError(
            f"{source.name} needs {address[:200]!r}, which is not a file in its folder: pack all into one .glb file."
        )
    return name


def _buffer(source: Path, row: Json, binary: memoryview | None) -> memoryview | None:
    address = row.get("uri")
    if address is None:
        return binary
    if _is_inside(address):
        return _decoded(source, address)
    name = _file_name(source, address)
    path = beside(source, name)
    if path is None or is_missing(source, name):
        raise MeshError(f"{source.name} needs the file {name!r}, which is missing or cannot be read: put it there.")
    return memoryview(path.read_bytes())


def _decoded(source: Path, address: str) -> memoryview:
    _, separator, text = address.partition(";base64,")
    try:
        if separator:
            return memoryview(base64.b64decode(text))
    except (binascii.Error, ValueError) as error:
        raise damaged(source, "a buffer in it is no base64") from error
    raise damaged(source, "a buffer in it is no base64")
