"""What an object or an instance tells its materials: its colour, its random number, its own and its instancer's values.

Object Info nodes and Attribute nodes of type Object, Instancer and View Layer have
one value all over an object, so they are plain colours and numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import bpy

from .node_links import Source

RGBA = tuple[float, float, float, float]

_WORD: Final = 0xFFFFFFFF
_NO_LEVEL: Final = 2**31 - 1
"""Stands in an instance's numbers for a level that is not there."""


@dataclass(frozen=True, slots=True, eq=False)
class ObjectValues:
    """What an object tells its materials.

    Attributes
    ----------
    colour : RGBA
        Viewport colour of the object; of an instance that of its instancer.
    location : 3 floats
        In the world.
    index : float
        Pass index.
    random : float
        0 to 1, the same as in Cycles and EEVEE.
    own, instancer, view_layer : tuple
        Where attributes of these types are looked up, in this order: pairs of a
        name and a colour, or datablocks.
    """

    colour: RGBA
    location: tuple[float, float, float]
    index: float
    random: float
    own: tuple[Any, ...]
    instancer: tuple[Any, ...]
    view_layer: tuple[Any, ...]

    @staticmethod
    def of(instance: bpy.types.DepsgraphObjectInstance, depsgraph: bpy.types.Depsgraph) -> ObjectValues:
        """Gather the values of an instance while the instances are walked."""
        obj, parent = instance.object, instance.parent if instance.is_instance else instance.object
        own = _datablocks(obj.original)
        number = instance.random_id & _WORD if instance.is_instance else _scrambled(_hashed(obj.name))
        return ObjectValues(
            colour=tuple(parent.color),
            location=tuple(instance.matrix_world.translation),
            index=float(obj.pass_index),
            random=number / _WORD,
            own=own,
            # what is no instance is its own instancer
            instancer=(*_instance_attributes(instance), *_datablocks(parent.original)) if instance.is_instance else own,
            view_layer=(depsgraph.view_layer, depsgraph.scene.original, depsgraph.scene.world),
        )

    def attribute(self, kind: str, name: str) -> RGBA:
        """Return an attribute by the type of its node; black where there is none, as in Blender's renderers."""
        for place in {"OBJECT": self.own, "INSTANCER": self.instancer, "VIEW_LAYER": self.view_layer}[kind]:
            value = place.get(name) if isinstance(place, dict) else _value(place, name)
            colour = _rgba(value)
            if colour is not None:
                return colour
        return 0.0, 0.0, 0.0, 0.0


def constant(source: Source) -> RGBA | tuple[float, ...] | float | None:
    """Return what a node puts out wherever on the object one looks, None where it is not a matter of the object.

    Parameters
    ----------
    source : Source
        A node and its output.

    Returns
    -------
    4 floats or None
        A number as a grey.
    """
    values, node, name = source.values, source.node, source.output.name
    if values is None:
        return None
    if node.bl_idname == "ShaderNodeAttribute" and node.attribute_type != "GEOMETRY":
        return values.attribute(node.attribute_type, node.attribute_name)
    if node.bl_idname != "ShaderNodeObjectInfo":
        return None
    if name == "Color":
        return values.colour
    if name == "Location":
        return (*values.location, 1.0)
    number = {"Alpha": values.colour[3], "Object Index": values.index, "Random": values.random}.get(name)
    return None if number is None else (number, number, number, number)


def _datablocks(obj: bpy.types.Object) -> tuple[Any, ...]:
    return (obj,) if obj.data is None else (obj, obj.data)


def _instance_attributes(instance: bpy.types.DepsgraphObjectInstance) -> tuple[dict[str, RGBA], ...]:
    """Return the attributes that Geometry Nodes gave an instance, by name."""
    parent = instance.parent
    # a geometry set can be asked from Blender 4.5 on
    if parent.type == "EMPTY" or not hasattr(parent, "evaluated_geometry"):
        return ()
    # the cloud lives as long as the geometry that it is taken from
    geometry = parent.evaluated_geometry()
    cloud = geometry.instances_pointcloud()
    levels = [number for number in instance.persistent_id if number != _NO_LEVEL]
    if cloud is None or not levels:
        return ()
    row = levels[-1]
    if "id" in cloud.attributes or not 0 <= row < len(cloud.points):
        row = _nearest(cloud, parent.matrix_world.inverted_safe() @ instance.matrix_world.translation)
    found = {each.name: _rgba(_item(each.data[row])) for each in cloud.attributes if len(each.data) > row}
    return ({name: colour for name, colour in found.items() if colour is not None},)


def _nearest(cloud: Any, place: Any) -> int:
    """Return the instance nearest to a place; numbers of their own do not count the rows."""
    transforms = cloud.attributes["instance_transform"].data
    return min(range(len(transforms)), key=lambda row: (transforms[row].value.translation - place).length)


def _item(item: Any) -> Any:
    return next((getattr(item, name) for name in ("color", "vector", "value") if hasattr(item, name)), None)


def _value(datablock: Any, name: str) -> Any:
    """Return a custom property, or a property of Blender's own."""
    if datablock is None:
        return None
    if name in datablock:
        return datablock[name]
    try:
        return datablock.path_resolve(name)
    except ValueError:
        return None


def _rgba(value: Any) -> RGBA | None:
    """Return a number as a grey and an array as a colour, None for anything else."""
    if isinstance(value, (bool, int, float)):
        return (float(value),) * 3 + (1.0,)
    if value is None or isinstance(value, (str, bytes)) or not hasattr(value, "__len__"):
        return None
    numbers = [each for each in value if isinstance(each, (int, float))]
    if len(numbers) != len(value) or not 2 <= len(numbers) <= 4:
        return None
    return _padded([float(number) for number in numbers])


def _padded(numbers: Sequence[float]) -> RGBA:
    red, green, blue, alpha = (*numbers, *(0.0, 0.0, 0.0, 1.0)[len(numbers) :])
    return red, green, blue, alpha


def _hashed(name: str) -> int:
    """Return Blender's hash of a name: its bytes as digits to the base 37."""
    total = 0
    for byte in name.encode():
        total = (total * 37 + byte) & _WORD
    return total


def _scrambled(number: int) -> int:
    """Return a number with its bits mixed, by the last step of B. Jenkins' hash lookup3 with a second number of 0."""
    b = c = (0xDEADBEEF + (2 << 2) + 13) & _WORD
    a = (b + number) & _WORD
    for turn in (14, 11, 25, 16, 4, 14, 24):
        # the three take turns: c from b, a from c, b from a
        c = ((c ^ b) - (b << turn & _WORD | b >> 32 - turn)) & _WORD
        a, b, c = b, c, a
    return b
