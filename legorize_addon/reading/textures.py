"""Images on surfaces, as image nodes of a material place them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import bpy
import numpy as np
from mathutils import Euler

from .node_links import NotAProduct, Place, Source, follow

Affine = tuple[tuple[float, float, float], tuple[float, float, float]]
"""Two rows of three numbers, applied to (u, v, 1)."""

SAME_PLACE: Final[Affine] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))

_UV_NODES: Final = ("ShaderNodeUVMap", "ShaderNodeTexCoord")
_MOVING: Final = ("MOVIE", "SEQUENCE", "VIEWER")


@dataclass(frozen=True, slots=True)
class Texture:
    """An image on a surface.

    Attributes
    ----------
    image : bpy.types.Image or None
        The image; None where the node has none.
    wrap : str
        ``REPEAT``, ``EXTEND``, ``CLIP`` or ``MIRROR``: the image node's extension.
    uv_map : str or None
        Name of the UV map, empty for the one that is active for render, None
        for a mesh without any.
    mapping : 2 x 3 floats
        Image coordinates are ``mapping @ (u, v, 1)``.
    """

    image: bpy.types.Image | None
    wrap: str = "REPEAT"
    uv_map: str | None = ""
    mapping: Affine = SAME_PLACE

    def lies_as(self, other: Texture) -> bool:
        """Return whether texels at the same share of both images lie at the same place of the surface."""
        own, its = ((each.wrap, each.uv_map, each.mapping) for each in (self, other))
        return own == its and "TILED" not in (self.image.source, other.image.source)


def read_texture(source: Source) -> Texture:
    """Return the image of an image node and how it lies; ``NotAProduct`` where only a renderer can tell."""
    node = source.node
    if node.projection != "FLAT" or (node.image is not None and node.image.source in _MOVING):
        raise NotAProduct
    legacy = node.texture_mapping
    if (*legacy.translation, *legacy.rotation, *legacy.scale) != (0, 0, 0, 0, 0, 0, 1, 1, 1):
        raise NotAProduct
    uv_map, mapping = _coordinates(source.input("Vector"))
    return Texture(node.image, node.extension, uv_map, mapping)


def _coordinates(place: Place) -> tuple[str, Affine]:
    """Return the UV map behind a vector socket, and the affine map applied to it."""
    source, _ = follow(place)
    if source is None:
        return "", SAME_PLACE
    node = source.node
    if node.bl_idname == "ShaderNodeMapping" and follow(source.input("Vector"))[0] is not None:
        uv_map, inner = _coordinates(source.input("Vector"))
        first, second = (_mapping(source) @ np.vstack([inner, (0.0, 0.0, 1.0)])).tolist()
        return uv_map, (tuple(first), tuple(second))
    if node.bl_idname == "ShaderNodeAttribute" and source.output.name == "Vector":
        return node.attribute_name, SAME_PLACE
    if node.bl_idname in _UV_NODES and source.output.name == "UV" and not node.from_instancer:
        return getattr(node, "uv_map", ""), SAME_PLACE
    raise NotAProduct


def _mapping(source: Source) -> np.ndarray:
    """Return the 2 x 3 matrix that a Mapping node applies to (u, v, 1)."""
    location, angles, scale = (_vector(source.input(name)) for name in ("Location", "Rotation", "Scale"))
    turn = np.array(Euler(angles).to_matrix())
    kind = source.node.vector_type
    if kind == "NORMAL":
        raise NotAProduct
    if kind == "TEXTURE":
        linear = np.diag(1 / np.where(scale == 0, 1, scale)) @ turn.T
        location = -linear @ location
    else:
        linear = turn @ np.diag(scale)
        location = location * (kind == "POINT")
    return np.column_stack([linear[:2, :2], location[:2]])


def _vector(place: Place) -> np.ndarray:
    source, socket = follow(place)
    if source is not None:
        raise NotAProduct
    return np.array(socket.default_value[:3], dtype=float)
