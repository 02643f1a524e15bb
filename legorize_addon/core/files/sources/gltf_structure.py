"""The parts of a glTF document name each other by numbers: whether there is what they name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, Final, TypeAlias

from .damage import damaged

Json: TypeAlias = dict[str, Any]

_TABLES: Final = (
    *("accessors", "animations", "bufferViews", "buffers", "cameras", "images", "materials", "meshes", "nodes"),
    *("samplers", "scenes", "skins", "textures"),
)

_NAMED: Final = {
    "scene": "scenes",
    "scenes/*/nodes/*": "nodes",
    "nodes/*/children/*": "nodes",
    "nodes/*/mesh": "meshes",
    "nodes/*/skin": "skins",
    "nodes/*/camera": "cameras",
    "nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/*": "accessors",
    "meshes/*/primitives/*/attributes/*": "accessors",
    "meshes/*/primitives/*/indices": "accessors",
    "meshes/*/primitives/*/material": "materials",
    "meshes/*/primitives/*/targets/*/*": "accessors",
    "meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView": "bufferViews",
    "accessors/*/bufferView": "bufferViews",
    "accessors/*/sparse/indices/bufferView": "bufferViews",
    "accessors/*/sparse/values/bufferView": "bufferViews",
    "bufferViews/*/buffer": "buffers",
    "images/*/bufferView": "bufferViews",
    "textures/*/source": "images",
    "textures/*/sampler": "samplers",
    "textures/*/extensions/EXT_texture_webp/source": "images",
    "materials/*/pbrMetallicRoughness/*Texture/index": "textures",
    "materials/*/*Texture/index": "textures",
    "materials/*/extensions/*/*Texture/index": "textures",
    "skins/*/joints/*": "nodes",
    "skins/*/skeleton": "nodes",
    "skins/*/inverseBindMatrices": "accessors",
    "animations/*/channels/*/target/node": "nodes",
    "animations/*/samplers/*/input": "accessors",
    "animations/*/samplers/*/output": "accessors",
}
"""Where a document names a part by its number in a table (glTF 2.0, section 5); ``*`` stands for anything."""

_OBJECTS: Final = (
    "*/*/extensions",
    "accessors/*/sparse",
    "accessors/*/sparse/indices",
    "accessors/*/sparse/values",
    "meshes/*/primitives/*",
    "meshes/*/primitives/*/attributes",
    "meshes/*/primitives/*/extensions",
    "textures/*/extensions/*",
)
_LISTS: Final = ("extensionsRequired", "extensionsUsed", "meshes/*/primitives", "nodes/*/children", "scenes/*/nodes")
"""Places of objects and of lists that are gone through further on."""

_MODES: Final = 7
"""Kinds of primitives, numbered from 0."""


def check_structure(source: Path, document: Json) -> None:
    """Refuse a document that names parts it does not have, or whose nodes are no tree.

    Raises
    ------
    MeshError
        What is wrong, and where.
    """
    for table in _TABLES:
        rows = document.get(table, [])
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            raise damaged(source, f"its {table!r} are not a list of objects")
    for paths, kind in ((_OBJECTS, dict), (_LISTS, list)):
        for place, part in (found for path in paths for found in _values(document, path.split("/"))):
            if not isinstance(part, kind):
                raise damaged(
                    source,
                    f"{place} is {part!r}, not a{'n' * (kind is not list)} {'list' if kind is list else 'object'}",
                )
    for path, table in _NAMED.items():
        for place, number in _values(document, path.split("/")):
            if not _is_row(number, document.get(table, [])):
                raise damaged(source, f"{place} is {number!r}, but there are {len(document.get(table, []))} {table!r}")
    for place, mode in _values(document, ["meshes", "*", "primitives", "*", "mode"]):
        if not _is_row(mode, range(_MODES)):
            raise damaged(source, f"{place} is {mode!r}, which is not a kind of primitive")
    _check_tree(source, document.get("nodes", []))


def _values(part: Any, path: list[str], place: str = "") -> Iterator[tuple[str, Any]]:
    """Yield where a path leads from a part of the document, and what is there."""
    if not path:
        yield place.lstrip("/"), part
        return
    first, *rest = path
    for key, value in _members(part, first):
        yield from _values(value, rest, f"{place}/{key}")


def _members(part: Any, name: str) -> Iterable[tuple[Any, Any]]:
    """Return the members of a part whose name is given, or ends with what follows ``*``."""
    if isinstance(part, list) and name == "*":
        return enumerate(part)
    if not isinstance(part, dict):
        return ()
    if name[0] == "*":
        return [(key, value) for key, value in part.items() if key.endswith(name[1:])]
    return [(name, part[name])] if name in part else ()


def _is_row(number: Any, rows: Any) -> bool:
    return isinstance(number, int) and not isinstance(number, bool) and 0 <= number < len(rows)


def _check_tree(source: Path, nodes: list[Json]) -> None:
    """Refuse nodes with two parents, and such that are below themselves."""
    parent: dict[int, int] = {}
    for number, node in enumerate(nodes):
        for child in node.get("children", []):
            if child in parent:
                raise damaged(source, f"nodes/{child} has two parents")
            parent[child] = number
    # with one parent each, only a circle has no way up to a root
    below = {number for number in range(len(nodes)) if number not in parent}
    todo = list(below)
    while todo:
        todo = [child for number in todo for child in nodes[number].get("children", [])]
        below.update(todo)
    if len(below) < len(nodes):
        raise damaged(source, f"nodes/{min(set(range(len(nodes))) - below)} is below itself")
