"""How much of a material is seen: what alpha, transparent shaders and clear glass let through.

What a shader lets through unchanged shows what lies behind. Of glass that is the
share that all colours have in common: clear glass is not seen, red or black glass
is. Tricks with light paths count as a camera sees them.
"""

from __future__ import annotations

from typing import Any, Final

from .expressions import OPERANDS, OPERATIONS, Expression, mixed, operation
from .node_links import SEE_THROUGH, NotAProduct, Place, Source, follow
from .object_values import constant
from .textures import read_texture

_GLASS: Final = ("ShaderNodeBsdfGlass", "ShaderNodeBsdfRefraction")
_LUMA: Final = (0.2126, 0.7152, 0.0722)
"""Shares of red, green and blue in the brightness (ITU-R BT.709), by which Blender turns colours into numbers."""

_CHANNELS: Final = {"Red": "red", "Green": "green", "Blue": "blue", "R": "red", "G": "green", "B": "blue"}


def opacity(source: Source) -> Expression:
    """Return how much of a shader is seen, 0 to 1.

    Raises
    ------
    NotAProduct
        If it must be baked.
    """
    node = source.node
    if node.bl_idname == "ShaderNodeMixShader":
        share, first, second = source.inputs()
        return mixed(number(share), _side(first), _side(second))
    if node.bl_idname == "ShaderNodeAddShader":
        return operation("MAXIMUM", *(_side(place) for place in source.inputs()))
    if node.bl_idname == "ShaderNodeBsdfTransparent":
        return operation("SUBTRACT", 1.0, _least(source.input("Color")))
    if node.bl_idname in SEE_THROUGH:
        return 0.0
    return operation("MULTIPLY", _alpha(source), operation("SUBTRACT", 1.0, _let_through(source)))


def _side(place: Place) -> Expression:
    """Return the opacity of what feeds a shader socket; nothing there is black."""
    source, _ = follow(place)
    return 1.0 if source is None else opacity(source)


def _alpha(source: Source) -> Expression:
    return operation("CLAMP", number(source.input("Alpha"))) if "Alpha" in source.node.inputs else 1.0


def _let_through(source: Source) -> Expression:
    """Return how much light passes a shader as it came."""
    if source.node.bl_idname in _GLASS:
        return _least(source.input("Color"))
    if "Transmission Weight" not in source.node.inputs:
        return 0.0
    share = number(source.input("Transmission Weight"))
    return 0.0 if share == 0.0 else operation("MULTIPLY", share, _least(source.input("Base Color")))


def _least(place: Place) -> Expression:
    """Return the least of the three channels of a colour."""
    source, socket = follow(place)
    colour = socket.default_value if source is None else constant(source)
    if colour is not None:
        return float(min(colour[:3]))
    if source.node.bl_idname == "ShaderNodeTexImage":
        return "image", read_texture(source), "least"
    raise NotAProduct


def number(place: Place) -> Expression:
    """Return the number that a socket takes.

    Raises
    ------
    NotAProduct
        If only a renderer can tell.
    """
    source, socket = follow(place)
    if source is None:
        return _plain(socket.default_value)
    node, name, fixed = source.node, source.output.name, constant(source)
    if fixed is not None:
        return _plain(fixed) if name != "Alpha" else float(fixed[3])
    reader = _READERS.get(node.bl_idname)
    if reader is None:
        raise NotAProduct
    return reader(source, name)


def _plain(value: Any) -> Expression:
    """Return a value as a number: of a colour its brightness."""
    if isinstance(value, (int, float)):
        return float(value)
    return float(sum(share * channel for share, channel in zip(_LUMA, value, strict=False)))


def _math(source: Source, _: str) -> Expression:
    node = source.node
    if node.operation not in OPERATIONS:
        raise NotAProduct
    operands = [number(place) for place in source.inputs()[: OPERANDS.get(node.operation, 2)]]
    result = operation(node.operation, *operands)
    return operation("CLAMP", result) if node.use_clamp else result


def _clamp(source: Source, _: str) -> Expression:
    value, low, high = (number(place) for place in source.inputs())
    if source.node.clamp_type != "MINMAX":
        raise NotAProduct
    return operation("MINIMUM", operation("MAXIMUM", value, low), high)


def _mix(source: Source, _: str) -> Expression:
    if source.node.data_type != "FLOAT":
        raise NotAProduct
    share, first, second = (number(source.input(name)) for name in ("Factor_Float", "A_Float", "B_Float"))
    return mixed(operation("CLAMP", share) if source.node.clamp_factor else share, first, second)


def _image(source: Source, name: str) -> Expression:
    return "image", read_texture(source), "alpha" if name == "Alpha" else "brightness"


def _channel(source: Source, name: str) -> Expression:
    above, _ = follow(source.inputs()[0])
    if above is None or above.node.bl_idname != "ShaderNodeTexImage" or getattr(source.node, "mode", "RGB") != "RGB":
        raise NotAProduct
    return "image", read_texture(above), _CHANNELS[name]


def _attribute(source: Source, name: str) -> Expression:
    node = source.node
    if name != "Alpha" or getattr(node, "attribute_type", "GEOMETRY") != "GEOMETRY":
        raise NotAProduct
    return "attribute", node.layer_name if node.bl_idname == "ShaderNodeVertexColor" else node.attribute_name


def _light_path(_: Source, name: str) -> Expression:
    if not name.startswith("Is "):
        raise NotAProduct
    return float(name == "Is Camera Ray")


_READERS: Final = {
    "ShaderNodeMath": _math,
    "ShaderNodeClamp": _clamp,
    "ShaderNodeMix": _mix,
    "ShaderNodeValue": lambda source, _: float(source.output.default_value),
    "ShaderNodeRGB": lambda source, _: _plain(source.output.default_value),
    "ShaderNodeTexImage": _image,
    "ShaderNodeSeparateColor": _channel,
    "ShaderNodeSeparateRGB": _channel,
    "ShaderNodeVertexColor": _attribute,
    "ShaderNodeAttribute": _attribute,
    "ShaderNodeLightPath": _light_path,
}
"""What reads the number that a node puts out."""
