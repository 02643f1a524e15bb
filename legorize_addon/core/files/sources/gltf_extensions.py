"""Extensions of glTF that stand between a file and Blender: compressed meshes and textures."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from pathlib import Path
from typing import Any, Final, TypeAlias

from ...errors import MeshError

Json: TypeAlias = dict[str, Any]

_CURES: Final = {
    "EXT_meshopt_compression": "decompress it first, for example with gltfpack, or with gltf-transform copy",
    "KHR_meshopt_compression": "decompress it first, for example with gltfpack, or with gltf-transform copy",
    "KHR_draco_mesh_compression": "decompress it first, for example with gltf-transform copy",
    "KHR_texture_basisu": "decompress its textures first, for example with gltf-transform ktxdecompress",
    "EXT_texture_webp": "make its textures PNG first, for example with gltf-transform png",
    "EXT_texture_avif": "make its textures PNG first, for example with gltf-transform png",
}
_OTHERWISE: Final = "export it without this extension"
_KTX2: Final = b"\xabKTX 20\xbb\r\n\x1a\n"


def check_extensions(source: Path, document: Json, readable: Collection[str]) -> None:
    """Refuse a file that cannot be read without an extension that the importer lacks.

    Raises
    ------
    MeshError
        The extension's name and the cure.
    """
    required = document.get("extensionsRequired", [])
    for name in (*required, *_compressions(document)):
        if name not in readable:
            raise MeshError(f"{source.name} needs {name} of glTF, which this Blender cannot read: {cure(name)}.")


def cure(extension: str) -> str:
    """Return what helps against an extension that the importer lacks."""
    return _CURES.get(extension, _OTHERWISE)


def _compressions(document: Json) -> Iterator[str]:
    """Yield the compressions of meshes that a file uses, which the importer cannot pass over."""
    for view in document.get("bufferViews", []):
        yield from (name for name in view.get("extensions", {}) if name.endswith("_meshopt_compression"))
    for mesh in document.get("meshes", []):
        for primitive in mesh.get("primitives", []):
            yield from (name for name in primitive.get("extensions", {}) if name == "KHR_draco_mesh_compression")


def lost_textures(
    source: Path, document: Json, buffers: Sequence[memoryview | None], readable: Collection[str]
) -> tuple[str, ...]:
    """Return a remark on each extension whose textures the importer leaves out."""
    lost = {name for texture in document.get("textures", []) for name in _lost(texture, document, buffers, readable)}
    return tuple(
        f"Textures of {source.name} are left out, as this Blender cannot read {name} of glTF: {cure(name)}."
        for name in sorted(lost)
    )


def _lost(texture: Json, document: Json, buffers: Sequence[memoryview | None], readable: Collection[str]) -> list[str]:
    """Return the extension that a texture would need, if there is no other way to its image."""
    extensions = texture.get("extensions", {})
    if "source" in texture:
        image = document["images"][texture["source"]]
        return ["KHR_texture_basisu"] if _is_ktx2(image, document, buffers) else []
    if any(name in readable for name in extensions):
        return []
    return sorted(name for name in extensions if name.split("_")[1:2] == ["texture"])


def _is_ktx2(image: Json, document: Json, buffers: Sequence[memoryview | None]) -> bool:
    """Return whether an image is a compressed texture, whatever it calls itself."""
    if image.get("mimeType") == "image/ktx2" or str(image.get("uri", "")).lower().endswith(".ktx2"):
        return True
    if "bufferView" not in image:
        return False
    view = document["bufferViews"][image["bufferView"]]
    data = buffers[view["buffer"]]
    start = view.get("byteOffset", 0)
    return data is not None and bytes(data[start : start + len(_KTX2)]) == _KTX2
