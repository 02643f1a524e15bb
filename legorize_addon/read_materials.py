"""What colours a material: an image, a colour attribute and a plain colour, multiplied.

Nearly every material of downloaded and hand-made models is such a product of at
most one image, at most one colour attribute and constants. It is found by going
up the node tree from the active output. Everything else (procedural textures,
colour ramps, two images mixed, generated coordinates, ...) has no such product
and is left to :mod:`.bake`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final

import bpy
import numpy as np
from mathutils import Euler

from .node_links import SEE_THROUGH, NotAProduct, Place, Source, colour_input, follow, sources_above, surface_output

Affine = tuple[tuple[float, float, float], tuple[float, float, float]]
"""Two rows of three numbers, applied to (u, v, 1)."""

SAME_PLACE: Final[Affine] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))

_MIX_SOCKETS: Final = {
    "ShaderNodeMix": ("Factor_Float", "A_Color", "B_Color"),
    "ShaderNodeMixRGB": ("Fac", "Color1", "Color2"),
}
_IMAGE: Final = "ShaderNodeTexImage"
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
    cutout : bool
        Whether the alpha of the image decides what of the surface is seen.
    """

    image: bpy.types.Image | None
    wrap: str = "REPEAT"
    uv_map: str | None = ""
    mapping: Affine = SAME_PLACE
    cutout: bool = False


@dataclass(frozen=True, slots=True)
class Paint:
    """The colour of a surface: a product, in linear light.

    Attributes
    ----------
    factor : 3 floats
        Linear RGB; the colour itself where nothing else takes part.
    texture : Texture or None
        The image.
    attribute : str or None
        Name of the colour attribute; empty for the one that is active for render.
    """

    factor: tuple[float, float, float] = (1.0, 1.0, 1.0)
    texture: Texture | None = None
    attribute: str | None = None


def read_paint(material: bpy.types.Material) -> Paint:
    """Find what colours a material.

    Alpha counts only where the alpha of the very image that colours the surface
    reaches the shader's alpha or the factor that mixes it with a transparent one.

    Parameters
    ----------
    material : bpy.types.Material
        Original or evaluated; it is only read.

    Returns
    -------
    Paint
        The product that makes its base colour.

    Raises
    ------
    NotAProduct
        If the colour must be baked.
    """
    output = surface_output(material)
    surface = None if output is None else follow(Place(output.inputs["Surface"]))[0]
    if surface is None:
        return Paint(factor=tuple(material.diffuse_color[:3]))
    colour, alphas = _shader(surface, ())
    paint = _paint(colour)
    if paint.texture is not None and any(_alpha_reaches(place, paint.texture.image) for place in alphas):
        return replace(paint, texture=replace(paint.texture, cutout=True))
    return paint


def colour_images(material: bpy.types.Material) -> list[bpy.types.Image | None]:
    """Return the images of all image nodes that the colour of a material depends on."""
    output = surface_output(material)
    above = () if output is None else sources_above(Place(output.inputs["Surface"]))
    return [source.node.image for source in above if source.node.bl_idname == _IMAGE]


def _alpha_reaches(place: Place, image: bpy.types.Image | None) -> bool:
    return any(
        source.node.bl_idname == _IMAGE and source.output.name == "Alpha" and source.node.image == image
        for source in sources_above(place)
    )


def _shader(source: Source, alphas: tuple[Place, ...]) -> tuple[Place, tuple[Place, ...]]:
    """Follow the main path of the shaders to a colour; collect the sockets that say what is seen."""
    node = source.node
    if node.bl_idname in ("ShaderNodeMixShader", "ShaderNodeAddShader"):
        return _mixed_shader(source, alphas)
    colour = colour_input(node)
    if colour is None:
        raise NotAProduct
    if "Alpha" in node.inputs:
        alphas = (*alphas, Place(node.inputs["Alpha"], source.groups))
    return Place(colour, source.groups), alphas


def _mixed_shader(source: Source, alphas: tuple[Place, ...]) -> tuple[Place, tuple[Place, ...]]:
    """Leave out what is transparent; else the larger share is the main path, the first of a sum."""
    branches = [follow(place)[0] for place in source.inputs() if place.socket.type == "SHADER"]
    seen = [branch for branch in branches if branch is not None and branch.node.bl_idname not in SEE_THROUGH]
    if not seen:
        raise NotAProduct
    if source.node.bl_idname == "ShaderNodeAddShader":
        return _shader(seen[0], alphas)
    share = Place(source.node.inputs[0], source.groups)
    if len(seen) == 1:
        return _shader(seen[0], (*alphas, share))
    return _shader(seen[int(_number(share) > 0.5)], alphas)


def _paint(place: Place) -> Paint:
    source, socket = follow(place)
    if source is None:
        return Paint(factor=_colour(socket))
    kind = source.node.bl_idname
    if kind in _MIX_SOCKETS:
        return _mix(source)
    if kind == "ShaderNodeRGB":
        return Paint(factor=_colour(source.output))
    if source.output.name == "Color":
        if kind == _IMAGE:
            return Paint(texture=_texture(source))
        if kind == "ShaderNodeVertexColor":
            return Paint(attribute=source.node.layer_name)
        if kind == "ShaderNodeAttribute" and source.node.attribute_type == "GEOMETRY":
            return Paint(attribute=source.node.attribute_name)
    raise NotAProduct


def _colour(socket: Any) -> tuple[float, float, float]:
    if socket.type != "RGBA":
        raise NotAProduct
    red, green, blue, _ = socket.default_value
    return red, green, blue


def _number(place: Place) -> float:
    """Return the constant value of a socket."""
    source, socket = follow(place)
    if source is not None:
        raise NotAProduct
    return float(socket.default_value)


def _mix(source: Source) -> Paint:
    """Return the product of a Mix node: one of its sides, or anything multiplied by a constant."""
    node = source.node
    if getattr(node, "data_type", "RGBA") != "RGBA" or node.blend_type not in ("MIX", "MULTIPLY"):
        raise NotAProduct
    share, first, second = (source.input(name) for name in _MIX_SOCKETS[node.bl_idname])
    weight = min(max(_number(share), 0.0), 1.0)
    if weight == 0.0:
        return _paint(first)
    if node.blend_type == "MULTIPLY":
        return _product(_paint(first), _faded(_paint(second), weight))
    if weight < 1.0:
        raise NotAProduct
    return _paint(second)


def _faded(paint: Paint, weight: float) -> Paint:
    """Return what multiplying by a share of a paint comes to: 1 - weight + weight * paint."""
    if weight == 1.0:
        return paint
    if paint.texture is not None or paint.attribute is not None:
        raise NotAProduct
    red, green, blue = (1.0 - weight + weight * value for value in paint.factor)
    return Paint(factor=(red, green, blue))


def _product(first: Paint, second: Paint) -> Paint:
    if (first.texture and second.texture) or (first.attribute is not None and second.attribute is not None):
        raise NotAProduct
    red, green, blue = (a * b for a, b in zip(first.factor, second.factor, strict=True))
    return Paint(
        factor=(red, green, blue),
        texture=first.texture or second.texture,
        attribute=second.attribute if first.attribute is None else first.attribute,
    )


def _texture(source: Source) -> Texture:
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
