"""The Geometry-Nodes tree that turns brick points into instances.

The tree "Legorize Bricks" sets, on every point of a mesh, the object of a
collection that the point's attribute ``variant`` counts to, turned by its
attribute ``turn``. A plane hides the bricks whose middles lie beyond it and
leaves the data as they are. A switch turns to another collection, which the
attribute ``heat`` counts in: there the same parts have other colours. "Explode"
lifts each piece by its attribute ``tier``. From one on, "Steps" leaves what is
there after that many building steps, by the attributes ``step``, in which a
brick is placed, and ``removed``; until the step ``joined``, a piece stands
``aside``. With "Pale" a brick that was there before the last step counts so many
variants on: there the same parts are pale. "Hidden roles" has a bit for each
role whose bricks are left out, by their attribute ``role``.

See :mod:`.animated_tree` for the one that follows the frames.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, Final

import bpy

from ..core.units import PLATE

TREE_NAME: Final = "Legorize Bricks"
TREE_KEY: Final = "legorize_tree"
TREE_VERSION: Final = 7
ANIMATED_KEY: Final = "legorize_animated"
PARTS: Final = "Parts"
SECTION: Final = "Section"
HEAT_PARTS: Final = "Heat parts"
HEAT_MAP: Final = "Heat map"
EXPLODE: Final = "Explode"
STEPS: Final = "Steps"
PALE: Final = "Pale"
HIDDEN_ROLES: Final = "Hidden roles"

INTERFACE: Final = (
    ("Geometry", "INPUT", "NodeSocketGeometry"),
    (PARTS, "INPUT", "NodeSocketCollection"),
    (SECTION, "INPUT", "NodeSocketObject"),
    (HEAT_PARTS, "INPUT", "NodeSocketCollection"),
    (HEAT_MAP, "INPUT", "NodeSocketBool"),
    (EXPLODE, "INPUT", "NodeSocketFloat"),
    (STEPS, "INPUT", "NodeSocketInt"),
    (PALE, "INPUT", "NodeSocketInt"),
    (HIDDEN_ROLES, "INPUT", "NodeSocketInt"),
    ("Geometry", "OUTPUT", "NodeSocketGeometry"),
)

Node = tuple[str, tuple[int, int], dict[str, Any], dict[Any, Any]]
"""Type, place, properties, and values of unlinked inputs."""

Link = tuple[str, str | int, str, str | int]
"""Node and its output, node and its input."""

NODES: Final[dict[str, Node]] = {
    "In": ("NodeGroupInput", (-600, 0), {}, {}),
    "Out": ("NodeGroupOutput", (800, 0), {}, {}),
    "Variant": ("GeometryNodeInputNamedAttribute", (-400, -150), {"data_type": "INT"}, {"Name": "variant"}),
    "Heat": ("GeometryNodeInputNamedAttribute", (-400, -270), {"data_type": "INT"}, {"Name": "heat"}),
    "Pick": ("GeometryNodeSwitch", (-200, -200), {"input_type": "INT"}, {}),
    "Last": ("ShaderNodeMath", (-1000, -900), {"operation": "SUBTRACT"}, {1: 1.0}),
    "Newest": ("FunctionNodeCompare", (-800, -900), {"data_type": "INT", "operation": "GREATER_EQUAL"}, {}),
    "Arrived": ("FunctionNodeCompare", (-800, -1100), {"data_type": "INT", "operation": "EQUAL"}, {}),
    "Bright": ("FunctionNodeBooleanMath", (-600, -1000), {"operation": "OR"}, {}),
    "Offset": ("GeometryNodeSwitch", (-400, -1000), {"input_type": "INT"}, {"True": 0}),
    "Paler": ("ShaderNodeMath", (-300, -100), {"operation": "ADD"}, {}),
    "Highlight": ("FunctionNodeCompare", (-400, -1150), {"data_type": "INT", "operation": "GREATER_THAN"}, {"B": 0}),
    "Shade": ("GeometryNodeSwitch", (-250, -50), {"input_type": "INT"}, {}),
    "Choice": ("GeometryNodeSwitch", (-400, 0), {"input_type": "COLLECTION"}, {}),
    "Turn": ("GeometryNodeInputNamedAttribute", (-400, -400), {"data_type": "INT"}, {"Name": "turn"}),
    "Angle": ("ShaderNodeMath", (-200, -400), {"operation": "MULTIPLY"}, {1: math.pi / 2}),
    "Rotation": ("FunctionNodeAxisAngleToRotation", (0, -400), {}, {"Axis": (0.0, 0.0, 1.0)}),
    "Height": ("GeometryNodeInputNamedAttribute", (-1200, 500), {"data_type": "INT"}, {"Name": "height"}),
    "Position": ("GeometryNodeInputPosition", (-800, 350), {}, {}),
    "Plane": ("GeometryNodeObjectInfo", (-1400, 200), {"transform_space": "RELATIVE"}, {}),
    "Inverse": ("FunctionNodeInvertMatrix", (-1200, 200), {}, {}),
    "Entries": ("FunctionNodeSeparateMatrix", (-1000, 200), {}, {}),
    "Upwards": ("ShaderNodeCombineXYZ", (-800, 250), {}, {}),
    "A plate": ("ShaderNodeMath", (-800, 100), {"operation": "MULTIPLY"}, {1: PLATE / 2}),
    "Limit": ("ShaderNodeMath", (-800, -50), {"operation": "MULTIPLY"}, {1: -1.0}),
    "Foot": ("ShaderNodeVectorMath", (-600, 350), {"operation": "DOT_PRODUCT"}, {}),
    "Middle": ("ShaderNodeMath", (-400, 350), {"operation": "MULTIPLY_ADD"}, {}),
    "Kept": ("FunctionNodeCompare", (-200, 200), {"data_type": "FLOAT", "operation": "LESS_EQUAL"}, {}),
    "Children": ("GeometryNodeCollectionInfo", (-200, 0), {}, {"Separate Children": True, "Reset Children": True}),
    "Preview": ("FunctionNodeCompare", (-600, 900), {"data_type": "INT", "operation": "GREATER_THAN"}, {"B": 0}),
    "Step": ("GeometryNodeInputNamedAttribute", (-600, 1350), {"data_type": "INT"}, {"Name": "step"}),
    "Placed": ("FunctionNodeCompare", (-400, 1350), {"data_type": "INT", "operation": "LESS_THAN"}, {}),
    "Removed": ("GeometryNodeInputNamedAttribute", (-600, 1150), {"data_type": "INT"}, {"Name": "removed"}),
    "Left": ("FunctionNodeCompare", (-400, 1150), {"data_type": "INT", "operation": "GREATER_EQUAL"}, {}),
    "There": ("FunctionNodeBooleanMath", (-200, 1250), {"operation": "AND"}, {}),
    "Both": ("FunctionNodeBooleanMath", (0, 1100), {"operation": "AND"}, {}),
    "Shown": ("GeometryNodeSwitch", (0, 300), {"input_type": "BOOLEAN"}, {}),
    "Role": ("GeometryNodeInputNamedAttribute", (-1000, 650), {"data_type": "INT"}, {"Name": "role"}),
    "Bit": ("ShaderNodeMath", (-800, 650), {"operation": "POWER"}, {0: 2.0}),
    "Shifted": ("ShaderNodeMath", (-600, 650), {"operation": "DIVIDE"}, {}),
    "Whole": ("ShaderNodeMath", (-400, 650), {"operation": "FLOOR"}, {}),
    "Lowest": ("ShaderNodeMath", (-200, 650), {"operation": "MODULO"}, {1: 2.0}),
    "Role shown": ("FunctionNodeCompare", (0, 650), {"data_type": "FLOAT", "operation": "LESS_THAN"}, {1: 0.5}),
    "Visible": ("FunctionNodeBooleanMath", (100, 500), {"operation": "AND"}, {}),
    "Instances": ("GeometryNodeInstanceOnPoints", (200, 0), {}, {"Pick Instance": True}),
    "Tier": ("GeometryNodeInputNamedAttribute", (-400, -600), {"data_type": "INT"}, {"Name": "tier"}),
    "Lift": ("ShaderNodeMath", (-200, -600), {"operation": "MULTIPLY"}, {}),
    "Raised": ("ShaderNodeCombineXYZ", (0, -600), {}, {}),
    "Joined": ("GeometryNodeInputNamedAttribute", (-400, -800), {"data_type": "INT"}, {"Name": "joined"}),
    "Alone": ("FunctionNodeCompare", (-200, -800), {"data_type": "INT", "operation": "GREATER_EQUAL"}, {}),
    "Apart": ("FunctionNodeBooleanMath", (0, -800), {"operation": "AND"}, {}),
    "Aside": ("GeometryNodeInputNamedAttribute", (0, -1000), {"data_type": "FLOAT_VECTOR"}, {"Name": "aside"}),
    "Way": ("GeometryNodeSwitch", (200, -700), {"input_type": "VECTOR"}, {}),
    "Exploded": ("FunctionNodeCompare", (0, -250), {"data_type": "FLOAT", "operation": "GREATER_THAN"}, {1: 0.0}),
    "Moving": ("FunctionNodeBooleanMath", (200, -250), {"operation": "OR"}, {}),
    "Moved": ("GeometryNodeTranslateInstances", (400, -300), {}, {"Local Space": False}),
    "Choose": ("GeometryNodeSwitch", (600, 0), {"input_type": "GEOMETRY"}, {}),
}

LINKS: Final[tuple[Link, ...]] = (
    ("In", "Geometry", "Instances", "Points"),
    ("In", HEAT_MAP, "Choice", "Switch"),
    ("In", PARTS, "Choice", "False"),
    ("In", HEAT_PARTS, "Choice", "True"),
    ("Choice", "Output", "Children", "Collection"),
    ("Children", "Instances", "Instances", "Instance"),
    ("In", HEAT_MAP, "Pick", "Switch"),
    ("In", STEPS, "Last", 0),
    ("Step", "Attribute", "Newest", "A"),
    ("Last", "Value", "Newest", "B"),
    ("Joined", "Attribute", "Arrived", "A"),
    ("Last", "Value", "Arrived", "B"),
    ("Newest", "Result", "Bright", 0),
    ("Arrived", "Result", "Bright", 1),
    ("Bright", "Boolean", "Offset", "Switch"),
    ("In", PALE, "Offset", "False"),
    ("Variant", "Attribute", "Paler", 0),
    ("Offset", "Output", "Paler", 1),
    ("In", PALE, "Highlight", "A"),
    ("Highlight", "Result", "Shade", "Switch"),
    ("Variant", "Attribute", "Shade", "False"),
    ("Paler", "Value", "Shade", "True"),
    ("Shade", "Output", "Pick", "False"),
    ("Heat", "Attribute", "Pick", "True"),
    ("Pick", "Output", "Instances", "Instance Index"),
    ("Turn", "Attribute", "Angle", 0),
    ("Angle", "Value", "Rotation", "Angle"),
    ("Rotation", "Rotation", "Instances", "Rotation"),
    ("In", SECTION, "Plane", "Object"),
    ("Plane", "Transform", "Inverse", "Matrix"),
    ("Inverse", "Matrix", "Entries", "Matrix"),
    # how far the middle of a brick's body is along the plane's z: the third row of the matrix, worked out once
    ("Entries", "Column 1 Row 3", "Upwards", "X"),
    ("Entries", "Column 2 Row 3", "Upwards", "Y"),
    ("Entries", "Column 3 Row 3", "Upwards", "Z"),
    ("Entries", "Column 3 Row 3", "A plate", 0),
    ("Entries", "Column 4 Row 3", "Limit", 0),
    ("Position", "Position", "Foot", 0),
    ("Upwards", "Vector", "Foot", 1),
    ("Height", "Attribute", "Middle", 0),
    ("A plate", "Value", "Middle", 1),
    ("Foot", "Value", "Middle", 2),
    ("Middle", "Value", "Kept", 0),
    ("Limit", "Value", "Kept", 1),
    ("Kept", "Result", "Shown", "False"),
    ("In", STEPS, "Preview", "A"),
    ("Preview", "Result", "Shown", "Switch"),
    ("Step", "Attribute", "Placed", "A"),
    ("In", STEPS, "Placed", "B"),
    ("Removed", "Attribute", "Left", "A"),
    ("In", STEPS, "Left", "B"),
    ("Placed", "Result", "There", 0),
    ("Left", "Result", "There", 1),
    ("Kept", "Result", "Both", 0),
    ("There", "Boolean", "Both", 1),
    ("Both", "Boolean", "Shown", "True"),
    ("Role", "Attribute", "Bit", 1),
    ("In", HIDDEN_ROLES, "Shifted", 0),
    ("Bit", "Value", "Shifted", 1),
    ("Shifted", "Value", "Whole", 0),
    ("Whole", "Value", "Lowest", 0),
    ("Lowest", "Value", "Role shown", 0),
    ("Shown", "Output", "Visible", 0),
    ("Role shown", "Result", "Visible", 1),
    ("Visible", "Boolean", "Instances", "Selection"),
    ("Tier", "Attribute", "Lift", 0),
    ("In", EXPLODE, "Lift", 1),
    ("Lift", "Value", "Raised", "Z"),
    ("Joined", "Attribute", "Alone", "A"),
    ("In", STEPS, "Alone", "B"),
    ("Preview", "Result", "Apart", 0),
    ("Alone", "Result", "Apart", 1),
    ("Apart", "Boolean", "Way", "Switch"),
    ("Raised", "Vector", "Way", "False"),
    ("Aside", "Attribute", "Way", "True"),
    ("In", EXPLODE, "Exploded", 0),
    ("Exploded", "Result", "Moving", 0),
    ("Preview", "Result", "Moving", 1),
    ("Instances", "Instances", "Moved", "Instances"),
    ("Way", "Output", "Moved", "Translation"),
    # nothing of this is evaluated where the switches are off
    ("Moving", "Boolean", "Choose", "Switch"),
    ("Instances", "Instances", "Choose", "False"),
    ("Moved", "Instances", "Choose", "True"),
    ("Choose", "Output", "Out", "Geometry"),
)


def brick_tree() -> bpy.types.NodeTree:
    """Return the Geometry-Nodes tree of this file, made at the first call."""
    for tree in bpy.data.node_groups:
        if tree.get(TREE_KEY) == TREE_VERSION and ANIMATED_KEY not in tree:
            return tree
    return make_tree(TREE_NAME, INTERFACE, NODES, LINKS)


def make_tree(
    name: str, interface: Iterable[tuple[str, str, str]], nodes: Mapping[str, Node], links: Iterable[Link]
) -> bpy.types.NodeTree:
    """Return a new tree of this version.

    Parameters
    ----------
    name : str
        Of the tree.
    interface : iterable of (str, str, str)
        Name, direction and type of each socket.
    nodes : mapping of str to Node
        By name.
    links : iterable of Link

    Returns
    -------
    bpy.types.NodeTree
    """
    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    tree[TREE_KEY] = TREE_VERSION
    tree.is_modifier = True
    for socket, direction, kind in interface:
        tree.interface.new_socket(socket, in_out=direction, socket_type=kind)
    for node, (kind, place, properties, values) in nodes.items():
        _add_node(tree, node, kind, place, properties, values)
    for source, output, target, entry in links:
        tree.links.new(_socket(tree.nodes[source].outputs, output), _socket(tree.nodes[target].inputs, entry))
    return tree


def brick_trees() -> list[bpy.types.NodeTree]:
    """Return the trees of this file, those of earlier versions included."""
    return [tree for tree in bpy.data.node_groups if TREE_KEY in tree]


def _add_node(
    tree: bpy.types.NodeTree,
    name: str,
    kind: str,
    place: tuple[int, int],
    properties: Mapping[str, Any],
    values: Mapping[Any, Any],
) -> None:
    node = tree.nodes.new(kind)
    node.name = name
    node.location = place
    for key, value in properties.items():
        setattr(node, key, value)
    for key, value in values.items():
        _socket(node.inputs, key).default_value = value


def _socket(sockets: Any, key: str | int) -> bpy.types.NodeSocket:
    # several sockets share a name, each for one data type: the one in use is enabled
    if isinstance(key, int):
        return sockets[key]
    return next(socket for socket in sockets if socket.name == key and socket.enabled)
