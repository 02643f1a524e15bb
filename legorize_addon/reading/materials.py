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

from .expressions import Expression, leaves
from .node_links import SEE_THROUGH, NotAProduct, Place, Source, colour_input, follow, sources_above, surface_output
from .object_values import ObjectValues, constant
from .opacity import number, opacity
from .textures import Texture, read_texture

_MIX_SOCKETS: Final = {
    "ShaderNodeMix": ("Factor_Float", "A_Color", "B_Color"),
    "ShaderNodeMixRGB": ("Fac", "Color1", "Color2"),
}
_IMAGE: Final = "ShaderNodeTexImage"
_CLEAR: Final = "ShaderNodeBsdfTransparent"


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
    opacity : Expression
        How much of the surface is seen, 0 to 1, see :mod:`.reading.expressions`.
    mask : Texture or None
        An image that takes no part in the colour but in the opacity.
    bare : 3 floats
        Linear RGB that the shader has where no image is linked to it.
    """

    factor: tuple[float, float, float] = (1.0, 1.0, 1.0)
    texture: Texture | None = None
    attribute: str | None = None
    opacity: Expression = 1.0
    mask: Texture | None = None
    bare: tuple[float, float, float] = (1.0, 1.0, 1.0)

    @property
    def placed(self) -> Texture | None:
        """The image that says where its texels lie on the surface."""
        return self.texture or self.mask


def read_paint(material: bpy.types.Material, values: ObjectValues | None = None) -> Paint:
    """Find what colours a material, and how much of it is seen.

    Parameters
    ----------
    material : bpy.types.Material
        Original or evaluated; it is only read.
    values : ObjectValues, optional
        What the object that wears it tells its materials.

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
    surface = None if output is None else follow(Place(output.inputs["Surface"], values=values))[0]
    if surface is None:
        return Paint(factor=tuple(material.diffuse_color[:3]))
    colour = _shader(surface)
    return replace(_paint(colour), opacity=opacity(surface), bare=tuple(colour.socket.default_value[:3]))


def textures_of(paint: Paint) -> list[Texture]:
    """Return the images of a paint: that of the colour, and those that decide what is seen."""
    own = [] if paint.texture is None else [paint.texture]
    return own + [leaf[1] for leaf in leaves(paint.opacity) if leaf[0] == "image"]


def colour_images(material: bpy.types.Material) -> list[bpy.types.Image | None]:
    """Return the images of all image nodes that the colour of a material depends on."""
    output = surface_output(material)
    above = () if output is None else sources_above(Place(output.inputs["Surface"]))
    return [source.node.image for source in above if source.node.bl_idname == _IMAGE]


def _shader(source: Source) -> Place:
    """Follow the main path of the shaders to a colour."""
    node = source.node
    if node.bl_idname in ("ShaderNodeMixShader", "ShaderNodeAddShader"):
        return _shader(_main_side(source))
    colour = colour_input(node)
    if colour is None and node.bl_idname == _CLEAR:
        colour = node.inputs["Color"]
    if colour is None:
        raise NotAProduct
    return Place(colour, source.groups, source.values)


def _main_side(source: Source) -> Source:
    """Leave out what is transparent; else the larger share is the main path, the first of a sum."""
    branches = [follow(place)[0] for place in source.inputs() if place.socket.type == "SHADER"]
    seen = [branch for branch in branches if branch is not None and branch.node.bl_idname not in SEE_THROUGH]
    if not seen:
        raise NotAProduct
    if len(seen) == 1 or source.node.bl_idname == "ShaderNodeAddShader":
        return seen[0]
    return seen[int(_number(Place(source.node.inputs[0], source.groups, source.values)) > 0.5)]


def _paint(place: Place) -> Paint:
    source, socket = follow(place)
    if source is None:
        return Paint(factor=_colour(socket))
    kind, fixed = source.node.bl_idname, constant(source)
    if fixed is not None:
        return Paint(factor=fixed[:3])
    if kind == "ShaderNodeValToRGB":
        return Paint(factor=tuple(source.node.color_ramp.evaluate(_number(source.input("Fac")))[:3]))
    if kind in _MIX_SOCKETS:
        return _mix(source)
    if kind == "ShaderNodeRGB":
        return Paint(factor=_colour(source.output))
    if source.output.name == "Color":
        if kind == _IMAGE:
            return Paint(texture=read_texture(source))
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
    value = number(place)
    if not isinstance(value, float):
        raise NotAProduct
    return value


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
    if weight == 1.0:
        return _paint(second)
    return _between(_paint(first), _paint(second), weight)


def _between(first: Paint, second: Paint, weight: float) -> Paint:
    """Return what lies between two plain colours."""
    if first.placed or second.placed or first.attribute is not None or second.attribute is not None:
        raise NotAProduct
    red, green, blue = ((1.0 - weight) * a + weight * b for a, b in zip(first.factor, second.factor, strict=True))
    return Paint(factor=(red, green, blue))


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
