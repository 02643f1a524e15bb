"""Going up the links of a shader node tree, through reroutes and node groups."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final

import bpy

SEE_THROUGH: Final = ("ShaderNodeBsdfTransparent", "ShaderNodeHoldout")
"""Shaders that show what lies behind."""


class NotAProduct(Exception):  # noqa: N818 - a finding, not an error
    """The colour is no product of an image, a colour attribute and a plain colour."""


@dataclass(frozen=True, slots=True)
class Place:
    """An input socket, the group nodes that were entered on the way to it, and what the object tells its materials."""

    socket: Any
    groups: tuple[Any, ...] = ()
    values: Any = None


@dataclass(frozen=True, slots=True)
class Source:
    """The node and its output that feed a place, the groups entered by then, and what the object tells."""

    node: Any
    output: Any
    groups: tuple[Any, ...]
    values: Any = None

    def input(self, identifier: str) -> Place:
        """Return an input of the node."""
        return Place(socket_by_identifier(self.node.inputs, identifier), self.groups, self.values)

    def inputs(self) -> list[Place]:
        """Return all inputs of the node."""
        return [Place(socket, self.groups, self.values) for socket in self.node.inputs]


def follow(place: Place) -> tuple[Source | None, Any]:
    """Find what feeds a socket.

    Parameters
    ----------
    place : Place
        Where to begin.

    Returns
    -------
    Source or None
        The first node above that is neither reroute nor group; None if nothing feeds the socket.
    bpy.types.NodeSocket
        The socket whose own value counts where nothing feeds it.

    Raises
    ------
    NotAProduct
        At a muted node or a group without output.
    """
    socket, groups = place.socket, place.groups
    while socket.is_linked and socket.links[0].is_valid and not socket.links[0].is_muted:
        node, output = socket.links[0].from_node, socket.links[0].from_socket
        if node.mute:
            raise NotAProduct
        if node.bl_idname == "NodeReroute":
            socket = node.inputs[0]
        elif node.bl_idname == "NodeGroupInput":
            socket, groups = socket_by_identifier(groups[-1].inputs, output.identifier), groups[:-1]
        elif node.bl_idname == "ShaderNodeGroup" and node.node_tree is not None:
            socket, groups = socket_by_identifier(_group_output(node).inputs, output.identifier), (*groups, node)
        else:
            return Source(node, output, groups, place.values), socket
    return None, socket


def sources_above(place: Place) -> Iterator[Source]:
    """Yield all that feeds a socket, directly or through other nodes; of a shader only what colours it.

    Parameters
    ----------
    place : Place
        Where to begin. Nodes behind a muted one are left out.
    """
    waiting, seen = [place], set()
    while waiting:
        try:
            source, _ = follow(waiting.pop())
        except NotAProduct:
            continue
        if source is None or source in seen:
            continue
        seen.add(source)
        yield source
        shades = any(output.type == "SHADER" for output in source.node.outputs)
        colour = colour_input(source.node) if shades else None
        waiting += source.inputs() if colour is None else [Place(colour, source.groups, source.values)]


def socket_by_identifier(sockets: Sequence[Any], identifier: str) -> Any:
    """Return the socket with an identifier; names need not be unique on a node."""
    return next(socket for socket in sockets if socket.identifier == identifier)


def surface_output(material: bpy.types.Material) -> bpy.types.Node | None:
    """Return the active output node of a material, None where it has no nodes."""
    # from 5.0 on every material has nodes, and asking for use_nodes warns
    if material.node_tree is None or (bpy.app.version < (5, 0, 0) and not material.use_nodes):
        return None
    return material.node_tree.get_output_node("ALL")


def colour_input(node: bpy.types.Node) -> bpy.types.NodeSocket | None:
    """Return the socket that colours a shader node, None where it has none."""
    if node.bl_idname in SEE_THROUGH:
        return None
    if node.bl_idname == "ShaderNodeBsdfPrincipled" and _only_glows(node):
        return node.inputs["Emission Color"]
    return next((node.inputs[name] for name in ("Base Color", "Color") if name in node.inputs), None)


def _only_glows(node: Any) -> bool:
    base, strength = node.inputs["Base Color"], node.inputs["Emission Strength"]
    return (
        not base.is_linked and max(base.default_value[:3]) == 0 and (strength.is_linked or strength.default_value > 0)
    )


def _group_output(group: Any) -> Any:
    found = [node for node in group.node_tree.nodes if node.bl_idname == "NodeGroupOutput" and node.is_active_output]
    if not found:
        raise NotAProduct
    return found[0]
