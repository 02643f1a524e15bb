"""Colours that are in no image, baked to one: procedural textures, mixed shaders, generated coordinates.

A copy of the mesh is unwrapped by xatlas, its materials are replaced by copies
that emit their base colour, and Cycles bakes what they emit; once more with
copies that emit how much of them is seen, unless all is. All of it happens in a
scene of its own; scene, copies and image are removed afterwards, also when
something fails.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from typing import Any, Final

import bmesh
import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ..core.errors import MeshError
from .colours import Floats
from .emitting import (
    PASSED_ON,
    emit_opacity,
    fix_missing_images,
    fix_object_values,
    keep_hidden_apart,
    replace_by_emission,
)
from .expressions import Expression
from .materials import Paint
from .node_links import SEE_THROUGH, NotAProduct, Place, colour_input, follow, surface_output
from .object_values import ObjectValues
from .opacity import opacity
from .textures import Texture

Mask = NDArray[np.bool_]

_NAME: Final = "legorize bake"
_TEXELS_ACROSS: Final = 512
"""Texels along the longest side of the object: more than ten a stud at the default size."""

_MOST_TEXELS: Final = 8_000_000
"""Texels of the surface; a very folded one gets larger texels."""

_OUTSIDE: Final = -1.0
"""Where the corners go that are not baked: beside the image."""

_MARGIN: Final = 4
_SAMPLES: Final = 4


@dataclass(frozen=True, slots=True, eq=False)
class Bakeable:
    """A mesh some of whose slots must be baked, with all that it takes, apart from its object.

    Attributes
    ----------
    name : str
        Of the object.
    mesh : bmesh.types.BMesh
        Triangles, with all attributes.
    matrix : (4, 4) float64 array
        Object to world.
    paints : tuple of (Paint or None)
        One for each slot; None: to be baked.
    materials : tuple of (bpy.types.Material or None)
        Original material of each slot.
    render_layers : two str
        UV map and colour attribute that are active for render; empty if there is none.
    values : ObjectValues
        What the object tells its materials.
    """

    name: str
    mesh: bmesh.types.BMesh
    matrix: Floats
    paints: tuple[Paint | None, ...]
    materials: tuple[bpy.types.Material | None, ...]
    render_layers: tuple[str, str]
    values: ObjectValues

    @staticmethod
    def of(
        name: str,
        mesh: bpy.types.Mesh,
        matrix: Floats,
        paints: tuple[Paint | None, ...],
        materials: list[bpy.types.Material | None],
        values: ObjectValues,
    ) -> Bakeable:
        """Copy an evaluated mesh; nothing of it is needed afterwards."""
        copy = bmesh.new()
        copy.from_mesh(mesh)
        bmesh.ops.triangulate(copy, faces=copy.faces[:])
        uv_map = next((layer.name for layer in mesh.uv_layers if layer.active_render), "")
        colour = mesh.color_attributes.render_color_index
        return Bakeable(
            name=name,
            mesh=copy,
            matrix=matrix,
            paints=paints,
            materials=tuple(material and material.original for material in materials),
            render_layers=(uv_map, mesh.color_attributes[colour].name if colour >= 0 else ""),
            values=values,
        )


@contextmanager
def baked(source: Bakeable) -> Iterator[tuple[bpy.types.Mesh, tuple[Paint, ...]]]:
    """Bake the slots without paint, for as long as the context lasts.

    Parameters
    ----------
    source : Bakeable
        Its BMesh is freed at the end.

    Yields
    ------
    bpy.types.Mesh
        A temporary copy of the mesh with one UV map more.
    tuple of Paint
        One for each slot; the baked ones use a temporary image.

    Raises
    ------
    MeshError
        If xatlas or Cycles is missing, or the mesh has no room for a UV map.
    """
    with ExitStack() as undo:
        undo.callback(source.mesh.free)
        mesh = _temporary(undo, bpy.data.meshes, bpy.data.meshes.new(_NAME))
        source.mesh.to_mesh(mesh)
        for _ in source.paints:
            mesh.materials.append(None)
        size = _unwrap(mesh, source)
        seen = [
            1.0 if paint is not None else _opacity(material, source.values)
            for material, paint in zip(source.materials, source.paints, strict=True)
        ]
        # what images alone decide is baked too, as the image baked lies elsewhere
        alpha = (
            None if all(isinstance(each, float) for each in seen) else _baked(undo, mesh, source, size, emit_opacity)
        )
        image = _baked(undo, mesh, source, size, _emit_colours)
        yield (
            mesh,
            tuple(
                _own_paint(image, alpha, each) if paint is None else paint
                for paint, each in zip(source.paints, seen, strict=True)
            ),
        )


def _own_paint(image: bpy.types.Image, alpha: bpy.types.Image | None, seen: Expression | None) -> Paint:
    """Return what paints a slot that was baked; its opacity is a number or was baked."""
    texture = Texture(image, wrap="EXTEND", uv_map=_NAME)
    if isinstance(seen, float):
        return Paint(texture=texture, opacity=seen)
    return Paint(texture=texture, opacity=("image", replace(texture, image=alpha), "brightness"))


def _opacity(material: bpy.types.Material | None, values: ObjectValues) -> Expression | None:
    """Return how much of a material is seen, None where only a renderer can tell."""
    output = None if material is None else surface_output(material)
    if output is None:
        return 1.0
    try:
        surface, _ = follow(Place(output.inputs["Surface"], values=values))
        return 1.0 if surface is None else opacity(surface)
    except NotAProduct:
        return None


def _baked(
    undo: ExitStack, mesh: bpy.types.Mesh, source: Bakeable, size: tuple[int, int], emit: Callable[..., None]
) -> bpy.types.Image:
    """Bake what copies of the materials emit into a new image."""
    image = _temporary(undo, bpy.data.images, bpy.data.images.new(_NAME, *size, float_buffer=True))
    for slot, (material, paint) in enumerate(zip(source.materials, source.paints, strict=True)):
        mesh.materials[slot] = _emitting(undo, material if paint is None else None, image, source.values, emit)
    _bake(undo, mesh, source)
    return image


def _temporary(undo: ExitStack, collection: Any, block: Any) -> Any:
    """Have a new datablock removed at the end."""
    undo.callback(collection.remove, block)
    return block


def _unwrap(mesh: bpy.types.Mesh, source: Bakeable) -> tuple[int, int]:
    """Give the triangles to be baked a UV map of their own; return the size of the image."""
    positions, faces, chosen = _triangles(mesh, source)
    atlas = _xatlas(source.name).Atlas()
    atlas.add_mesh(positions, faces[chosen])
    options = _xatlas(source.name).PackOptions()
    options.padding, options.texels_per_unit = _MARGIN, _texels_per_unit(positions[faces[chosen]])
    atlas.generate(pack_options=options)
    _, corners, places = atlas[0]
    uvs = np.full((len(chosen), 3, 2), _OUTSIDE, dtype=np.float32)
    uvs[chosen] = places[corners]
    render_uv_map, render_colour = source.render_layers
    layer = mesh.uv_layers.new(name=_NAME, do_init=False)
    if layer is None:
        raise MeshError(f"{source.name!r} has so many UV maps that baking cannot add another: remove one.")
    layer.uv.foreach_set("vector", uvs.ravel())
    # a BMesh does not know which layers are active for render
    if render_uv_map:
        mesh.uv_layers[render_uv_map].active_render = True
    if render_colour:
        mesh.color_attributes.render_color_index = mesh.color_attributes.find(render_colour)
    return atlas.width, atlas.height


def _xatlas(name: str) -> Any:
    """Return xatlas, which is not needed before something is baked."""
    try:
        import xatlas
    except ImportError as error:
        raise MeshError(
            f"The colours of {name!r} are made by nodes and must be baked, but the Python package xatlas is missing: "
            "install the extension with its wheels, or give the object an image texture."
        ) from error
    return xatlas


def _triangles(mesh: bpy.types.Mesh, source: Bakeable) -> tuple[NDArray[np.float32], NDArray[np.uint32], Mask]:
    """Return the vertices in the world, the longest side of their box 1 long, the triangles, and which to bake."""
    own = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
    mesh.vertices.foreach_get("co", own)
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    slot = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("material_index", slot)
    positions = own.reshape(-1, 3) @ source.matrix[:3, :3].T
    positions = (positions - positions.min(axis=0)) / np.ptp(positions, axis=0).max()
    needed = np.array([paint is None for paint in source.paints])
    chosen = needed[np.clip(slot, 0, len(needed) - 1)]
    return positions.astype(np.float32), corners.reshape(-1, 3).astype(np.uint32), chosen


def _texels_per_unit(triangles: NDArray[np.float32]) -> float:
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    return float(min(_TEXELS_ACROSS, np.sqrt(_MOST_TEXELS / max(area.sum() / 2, 1e-12))))


def _emitting(
    undo: ExitStack,
    material: bpy.types.Material | None,
    image: bpy.types.Image,
    values: ObjectValues,
    emit: Callable[..., None],
) -> bpy.types.Material:
    """Return a temporary material that emits something of another one and receives the bake."""
    copy = bpy.data.materials.new(_NAME) if material is None else material.copy()
    _temporary(undo, bpy.data.materials, copy)
    if bpy.app.version < (5, 0, 0):
        copy.use_nodes = True
    for tree in _own_trees(undo, copy.node_tree):
        fix_object_values(tree, values)
        fix_missing_images(tree)
        keep_hidden_apart(tree)
        emit(tree)
    target = copy.node_tree.nodes.new("ShaderNodeTexImage")
    target.image = image
    copy.node_tree.nodes.active = target
    return copy


def _own_trees(undo: ExitStack, tree: bpy.types.NodeTree) -> Iterator[bpy.types.NodeTree]:
    """Put copies in the place of the groups of a tree, at any depth; yield the copies and the tree."""
    for node in list(tree.nodes):
        if node.bl_idname == "ShaderNodeGroup" and node.node_tree is not None:
            node.node_tree = _temporary(undo, bpy.data.node_groups, node.node_tree.copy())
            yield from _own_trees(undo, node.node_tree)
    yield tree


def _emit_colours(tree: bpy.types.NodeTree) -> None:
    """Put an emission of its colour in the place of every shader of a tree."""
    for node in list(tree.nodes):
        if node.bl_idname == "ShaderNodeMixShader":
            _skip_transparent(tree, node)
        elif node.bl_idname == "ShaderNodeOutputMaterial":
            for name in ("Volume", "Displacement"):
                _unlink(tree, node.inputs[name])
    for node in list(tree.nodes):
        shown = [output for output in node.outputs if output.type == "SHADER" and output.is_linked]
        colour = colour_input(node) if shown and node.bl_idname not in PASSED_ON else None
        if colour is not None:
            value = colour.links[0].from_socket if colour.is_linked else tuple(colour.default_value)
            replace_by_emission(tree, value, shown[0])


def _skip_transparent(tree: bpy.types.NodeTree, mix: Any) -> None:
    """Show only the opaque side where a shader is mixed with a transparent one."""
    sides = [socket for socket in mix.inputs if socket.type == "SHADER" and socket.is_linked]
    opaque = [socket for socket in sides if socket.links[0].from_node.bl_idname not in SEE_THROUGH]
    if len(opaque) == 1:
        for link in list(mix.outputs[0].links):
            tree.links.new(opaque[0].links[0].from_socket, link.to_socket)


def _unlink(tree: bpy.types.NodeTree, socket: Any) -> None:
    for link in list(socket.links):
        tree.links.remove(link)


def _bake(undo: ExitStack, mesh: bpy.types.Mesh, source: Bakeable) -> None:
    """Bake what the mesh emits, in a scene of its own."""
    obj = _temporary(undo, bpy.data.objects, bpy.data.objects.new(_NAME, mesh))
    obj.matrix_world = Matrix(source.matrix)
    scene = _temporary(undo, bpy.data.scenes, bpy.data.scenes.new(_NAME))
    scene.collection.objects.link(obj)
    try:
        scene.render.engine = "CYCLES"
    except TypeError as error:
        raise MeshError("Baking needs Cycles: enable it in Preferences > Add-ons (Cycles Render Engine).") from error
    scene.cycles.device, scene.cycles.samples = "CPU", _SAMPLES
    layer = scene.view_layers[0]
    layer.objects.active = obj
    obj.select_set(True, view_layer=layer)
    with bpy.context.temp_override(
        scene=scene, view_layer=layer, active_object=obj, object=obj, selected_objects=[obj]
    ):
        bpy.ops.object.bake(
            type="EMIT", target="IMAGE_TEXTURES", uv_layer=_NAME, margin=_MARGIN, margin_type="EXTEND",
            use_clear=True, use_selected_to_active=False, use_split_materials=False,
        )  # fmt: skip
