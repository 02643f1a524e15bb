"""glTF: the container, extensions that Blender cannot read, and whether the parts fit together."""

from __future__ import annotations

import json
import struct
from collections.abc import Collection
from pathlib import Path
from typing import Any, Final, TypeAlias

from ...errors import MeshError
from .damage import damaged
from .gltf_arrays import check_arrays
from .gltf_buffers import buffers
from .gltf_extensions import check_extensions, lost_textures
from .gltf_structure import check_structure

Json: TypeAlias = dict[str, Any]

_VERSION: Final = "2.0"


def check_gltf(source: Path, extensions: Collection[str]) -> tuple[str, ...]:
    """Refuse a glTF file that the importer cannot read; tell which textures it cannot.

    Parameters
    ----------
    source : Path
        Either form: the importer goes by the content, not by the suffix.
    extensions : collection of str
        Those that the importer can read.
    """
    document, binary = read_gltf(source)
    _check_version(source, document)
    check_structure(source, document)
    check_extensions(source, document, extensions)
    data = buffers(source, document, binary)
    check_arrays(source, document, data)
    return lost_textures(source, document, data, extensions)


def read_gltf(source: Path) -> tuple[Json, memoryview | None]:
    """Return the document of a glTF file, and its binary part if it has one."""
    data = memoryview(source.read_bytes())
    text, binary = _chunks(source, data) if bytes(data[:4]) == b"glTF" else (data, None)
    try:
        # null stands for nothing, for Blender too
        document = json.loads(bytes(text).decode(), object_hook=_without_null)
    except (ValueError, RecursionError) as error:
        raise damaged(source, "its description is not JSON") from error
    if not isinstance(document, dict):
        raise damaged(source, "its description is not a JSON object")
    return document, binary


def _without_null(part: Json) -> Json:
    return {key: value for key, value in part.items() if value is not None}


def _chunks(source: Path, data: memoryview) -> tuple[memoryview, memoryview | None]:
    """Return the text and the binary part of a .glb file."""
    try:
        version, length = struct.unpack_from("<II", data, 4)
        size, kind = struct.unpack_from("<I4s", data, 12)
    except struct.error as error:
        raise damaged(source, "its header is cut off") from error
    if version != 2:
        raise MeshError(
            f"{source.name} is a .glb file of version {version}, but Blender reads version 2: export it again."
        )
    if length != len(data):
        raise damaged(source, f"its header says {length} bytes, but it has {len(data)}")
    if kind != b"JSON" or 20 + size > len(data):
        raise damaged(source, "its first part is not complete JSON")
    return data[20 : 20 + size], _binary(source, data[20 + size :])


def _binary(source: Path, rest: memoryview) -> memoryview | None:
    if not rest:
        return None
    if len(rest) < 8:
        raise damaged(source, "its second part is cut off")
    size, kind = struct.unpack_from("<I4s", rest)
    if size > len(rest) - 8:
        raise damaged(source, f"its second part should have {size} bytes, but {len(rest) - 8} follow")
    return rest[8 : 8 + size] if kind == b"BIN\0" else None


def _check_version(source: Path, document: Json) -> None:
    asset = document.get("asset")
    version = asset.get("version") if isinstance(asset, dict) else None
    if version != _VERSION:
        found = f"names version {version}" if isinstance(version, str) else "does not name its version"
        raise MeshError(f"{source.name} {found} of glTF, but Blender reads version {_VERSION}: export it again.")
