"""The Geometry-Nodes tree that builds a model frame by frame.

It has the inputs of the tree in :mod:`.brick_tree` and two more: from a frame on,
each building step takes so many frames. The bricks of a step fall into place one
after another, by their attribute ``moment``; what is taken out rises, and what
is joined comes over from where it stands. At the end of a step all is as
"Steps" shows it. It is a tree of its own, because one that looks at the time is
evaluated in every frame.
"""

from __future__ import annotations

from typing import Final

import bpy

from ..core.units import BRICK
from .assembly_columns import FALL, READY
from .brick_tree import ANIMATED_KEY, INTERFACE, LINKS, NODES, STEPS, TREE_KEY, TREE_VERSION, Link, Node, make_tree

FIRST: Final = "First frame"
FRAMES: Final = "Frames a step"

DROP: Final = 5 * BRICK
"""Height in mm from which bricks fall, and to which supports rise that are taken out."""

_UP: Final = 0.2
_OVER: Final = 0.6
"""Shares of a step until which what is joined is up, and over its place."""

_SMOOTH: Final = {"data_type": "FLOAT", "interpolation_type": "SMOOTHSTEP"}


def _smooth(start: float, end: float, before: float, after: float) -> dict[str, float]:
    return {"From Min": start, "From Max": end, "To Min": before, "To Max": after}


_NODES: Final[dict[str, Node]] = {
    "Clock": ("GeometryNodeInputSceneTime", (-2200, -1500), {}, {}),
    "Since": ("ShaderNodeMath", (-2000, -1500), {"operation": "SUBTRACT"}, {}),
    "Rate": ("ShaderNodeMath", (-1800, -1500), {"operation": "DIVIDE"}, {}),
    "Floor": ("ShaderNodeMath", (-1600, -1600), {"operation": "FLOOR"}, {}),
    "Begun": ("ShaderNodeMath", (-1400, -1600), {"operation": "MAXIMUM"}, {1: 0.0}),
    "Now": ("ShaderNodeMath", (-1200, -1600), {"operation": "ADD"}, {1: 1.0}),
    "Share": ("ShaderNodeMath", (-1200, -1400), {"operation": "SUBTRACT"}, {}),
    "Moment": ("GeometryNodeInputNamedAttribute", (-1200, -1250), {"data_type": "FLOAT"}, {"Name": "moment"}),
    "Own": ("ShaderNodeMath", (-1000, -1300), {"operation": "SUBTRACT"}, {}),
    "Waits": ("FunctionNodeCompare", (-800, -1250), {"data_type": "FLOAT", "operation": "LESS_THAN"}, {1: 0.0}),
    "Waiting": ("FunctionNodeBooleanMath", (-600, -1250), {"operation": "AND"}, {}),
    "Fall": ("ShaderNodeMapRange", (-800, -1450), _SMOOTH, _smooth(0.0, FALL, DROP, 0.0)),
    "Falls": ("GeometryNodeSwitch", (-600, -1450), {"input_type": "FLOAT"}, {"False": 0.0}),
    "Goes": ("FunctionNodeCompare", (-800, -1700), {"data_type": "INT", "operation": "EQUAL"}, {}),
    "Early": ("FunctionNodeCompare", (-800, -1900), {"data_type": "FLOAT", "operation": "LESS_THAN"}, {1: READY}),
    "Going": ("FunctionNodeBooleanMath", (-600, -1800), {"operation": "AND"}, {}),
    "Here": ("FunctionNodeBooleanMath", (-400, -1700), {"operation": "OR"}, {}),
    "Rise": ("ShaderNodeMapRange", (-600, -2000), _SMOOTH, _smooth(0.0, READY, 0.0, DROP)),
    "Rises": ("GeometryNodeSwitch", (-400, -2000), {"input_type": "FLOAT"}, {"False": 0.0}),
    "Over": ("ShaderNodeMapRange", (-600, -2300), _SMOOTH, _smooth(0.0, _OVER, 1.0, 0.0)),
    "Lifted": ("ShaderNodeMapRange", (-600, -2600), _SMOOTH, _smooth(0.0, _UP, 0.0, DROP)),
    "Lowered": ("ShaderNodeMapRange", (-600, -2900), _SMOOTH, _smooth(_OVER, READY, 0.0, DROP)),
    "Height above": ("ShaderNodeMath", (-400, -2700), {"operation": "SUBTRACT"}, {}),
    "Carried": ("GeometryNodeSwitch", (-200, -2700), {"input_type": "FLOAT"}, {"False": 0.0}),
    "Travel": ("ShaderNodeVectorMath", (-400, -2300), {"operation": "SCALE"}, {}),
    "Comes": ("GeometryNodeSwitch", (0, -2300), {"input_type": "VECTOR"}, {}),
    "Drop and rise": ("ShaderNodeMath", (-200, -1800), {"operation": "ADD"}, {}),
    "Above": ("ShaderNodeMath", (0, -1900), {"operation": "ADD"}, {}),
    "Vertical": ("ShaderNodeCombineXYZ", (200, -1900), {}, {}),
    "Total": ("ShaderNodeVectorMath", (400, -1500), {"operation": "ADD"}, {}),
    "Present": ("FunctionNodeBooleanMath", (-200, 1000), {"operation": "NIMPLY"}, {}),
}

_LINKS: Final[tuple[Link, ...]] = (
    ("Clock", "Frame", "Since", 0),
    ("In", FIRST, "Since", 1),
    ("Since", "Value", "Rate", 0),
    ("In", FRAMES, "Rate", 1),
    ("Rate", "Value", "Floor", 0),
    ("Floor", "Value", "Begun", 0),
    ("Begun", "Value", "Now", 0),
    ("Rate", "Value", "Share", 0),
    ("Begun", "Value", "Share", 1),
    # bricks of the step that is done: hidden until their moment, then falling
    ("Share", "Value", "Own", 0),
    ("Moment", "Attribute", "Own", 1),
    ("Own", "Value", "Waits", 0),
    ("Waits", "Result", "Waiting", 0),
    ("Newest", "Result", "Waiting", 1),
    ("There", "Boolean", "Present", 0),
    ("Waiting", "Boolean", "Present", 1),
    ("Own", "Value", "Fall", "Value"),
    ("Newest", "Result", "Falls", "Switch"),
    ("Fall", "Result", "Falls", "True"),
    # supports that are taken out
    ("Removed", "Attribute", "Goes", "A"),
    ("Last", "Value", "Goes", "B"),
    ("Share", "Value", "Early", 0),
    ("Goes", "Result", "Going", 0),
    ("Early", "Result", "Going", 1),
    ("Left", "Result", "Here", 0),
    ("Going", "Boolean", "Here", 1),
    ("Share", "Value", "Rise", "Value"),
    ("Going", "Boolean", "Rises", "Switch"),
    ("Rise", "Result", "Rises", "True"),
    # what is joined: up, over its place, and down
    ("Share", "Value", "Over", "Value"),
    ("Aside", "Attribute", "Travel", 0),
    ("Over", "Result", "Travel", "Scale"),
    ("Arrived", "Result", "Comes", "Switch"),
    ("Way", "Output", "Comes", "False"),
    ("Travel", "Vector", "Comes", "True"),
    ("Share", "Value", "Lifted", "Value"),
    ("Share", "Value", "Lowered", "Value"),
    ("Lifted", "Result", "Height above", 0),
    ("Lowered", "Result", "Height above", 1),
    ("Arrived", "Result", "Carried", "Switch"),
    ("Height above", "Value", "Carried", "True"),
    ("Falls", "Output", "Drop and rise", 0),
    ("Rises", "Output", "Drop and rise", 1),
    ("Drop and rise", "Value", "Above", 0),
    ("Carried", "Output", "Above", 1),
    ("Above", "Value", "Vertical", "Z"),
    ("Comes", "Output", "Total", 0),
    ("Vertical", "Vector", "Total", 1),
)

_INSTEAD: Final[dict[Link, Link]] = {
    ("Left", "Result", "There", 1): ("Here", "Boolean", "There", 1),
    ("There", "Boolean", "Both", 1): ("Present", "Boolean", "Both", 1),
    ("Way", "Output", "Moved", "Translation"): ("Total", "Vector", "Moved", "Translation"),
}
"""Links of the other tree that lead elsewhere in this one."""


def animated_tree() -> bpy.types.NodeTree:
    """Return the animated tree of this file, made at the first call."""
    for tree in bpy.data.node_groups:
        if tree.get(TREE_KEY) == TREE_VERSION and ANIMATED_KEY in tree:
            return tree
    inputs, output = INTERFACE[:-1], INTERFACE[-1]
    interface = (*inputs, (FIRST, "INPUT", "NodeSocketFloat"), (FRAMES, "INPUT", "NodeSocketFloat"), output)
    tree = make_tree("Legorize Bricks Animated", interface, NODES | _NODES, (*map(_led, LINKS), *_LINKS))
    tree[ANIMATED_KEY] = True
    return tree


def _led(link: Link) -> Link:
    """Return a link of the other tree as it is here: the step follows the frame."""
    source, output, target, entry = _INSTEAD.get(link, link)
    return ("Now", "Value", target, entry) if (source, output) == ("In", STEPS) else (source, output, target, entry)
