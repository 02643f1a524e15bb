"""Extensions of glTF that Blender lacks: compressed meshes and textures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import box_data, box_document, changed, refusal, write_glb

Json = dict[str, Any]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where the file of a test lies."""
    return tmp_path / "box.glb"


@pytest.mark.parametrize(
    ("name", "tool"),
    [
        ("EXT_meshopt_compression", "gltfpack"),
        ("KHR_draco_mesh_compression", "gltf-transform copy"),
        ("KHR_texture_basisu", "gltf-transform ktxdecompress"),
        ("ACME_shape", "export it without"),
    ],
)
def test_required_extension(name: str, tool: str, path: Path) -> None:
    """What the importer does not know is named, with the cure, unless it does know it."""
    write_glb(path, box_document() | {"extensionsRequired": [name], "extensionsUsed": [name]})
    sentence = refusal(path)
    assert name in sentence
    assert tool in sentence
    assert check_source(path, (name,)) == ()


def test_compression_counts_where_it_is_used(path: Path) -> None:
    """Compressed meshes need their extension, be it called required or not."""
    part = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
    document = changed("meshes/0/primitives/0/extensions", part)
    assert "KHR_draco_mesh_compression" in refusal(write_glb(path, document))
    part = {
        "EXT_meshopt_compression": {"buffer": 0, "byteLength": 96, "byteStride": 12, "count": 8, "mode": "ATTRIBUTES"}
    }
    assert "EXT_meshopt_compression" in refusal(write_glb(path, changed("bufferViews/0/extensions", part)))


def textured(texture: Json, image: Json, data: bytes = b"") -> tuple[Json, bytes]:
    """Return a box with a texture, whose image may lie in the buffer."""
    document = box_document()
    if data:
        image = image | {"bufferView": 2}
        document["bufferViews"].append({"buffer": 0, "byteOffset": 240, "byteLength": len(data)})
        document["buffers"][0]["byteLength"] += len(data)
    document |= {"textures": [texture], "images": [image]}
    document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    return document, box_data() + data


@pytest.mark.parametrize(
    ("texture", "image", "data", "lost"),
    [
        ({"extensions": {"KHR_texture_basisu": {"source": 0}}}, {"mimeType": "image/ktx2"}, b"x", "KHR_texture_basisu"),
        ({"source": 0, "extensions": {"KHR_texture_basisu": {"source": 0}}}, {"uri": "a.png"}, b"", ""),
        ({"source": 0}, {"mimeType": "image/png"}, b"\xabKTX 20\xbb\r\n\x1a\n....", "KHR_texture_basisu"),
        ({"source": 0}, {"mimeType": "image/png"}, b"\x89PNG", ""),
        ({"extensions": {"EXT_texture_webp": {"source": 0}}}, {"mimeType": "image/webp"}, b"x", "EXT_texture_webp"),
        ({"extensions": {"MSFT_texture_dds": {"source": 0}}}, {"uri": "a.dds"}, b"", "MSFT_texture_dds"),
        ({}, {"uri": "a.png"}, b"", ""),
    ],
)
def test_lost_textures(texture: Json, image: Json, data: bytes, lost: str, path: Path) -> None:
    """Textures that only an unknown extension holds are told once; where there is another image, nothing is lost."""
    document, data = textured(texture, image, data)
    document["textures"] *= 2
    remarks = check_source(write_glb(path, document, data), ())
    assert [lost in remark and remark.endswith(".") for remark in remarks] == [True] * bool(lost)
    assert check_source(path, ("KHR_texture_basisu", "EXT_texture_webp", "MSFT_texture_dds")) == () or "KTX" in str(
        data
    )
