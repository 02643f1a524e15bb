"""The triangles of one evaluated mesh, and what paints each of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.colours import linear_from_srgb
from .colours import Floats
from .expressions import Expression, evaluated, leaves, replaced
from .image_coordinates import in_images
from .images import Album, is_missing, is_readable, remark_on_missing
from .materials import Paint, colour_images, read_paint, textures_of
from .node_links import NotAProduct
from .object_values import ObjectValues

Ints = NDArray[np.int32]

_UNCOLOURED: Final = float(linear_from_srgb(np.uint8(160)))
"""Linear grey of a mesh without any colour; reliefs show better on it than on white."""


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """Triangles with their paints.

    Attributes
    ----------
    vertices : (n_v, 3) float64 array
        World coordinates in Blender units.
    faces : (n_f, 3) int32 array
        Counter-clockwise as seen from outside.
    uvs : (n_f, 3, 2) float64 array
        Coordinates of the UV map of each face's paint, 0 where it has none.
    paint : (n_f,) int32 array
        Row in ``paints``.
    paints : tuple of Paint
        One for each material slot.
    corners : (k, 3, 4) float64 array
        Linear colours and alpha of the corners of the faces whose paint has an attribute, in the order of the faces.
    """

    vertices: Floats
    faces: Ints
    uvs: Floats
    paint: Ints
    paints: tuple[Paint, ...]
    corners: Floats

    def images(self, album: Album) -> tuple[Floats, Ints]:
        """Put the images of the paints into an album.

        Returns
        -------
        (n_f, 3, 2) float64 array
            Coordinates in the images.
        (n_f,) int32 array
            Row in the album, -1 where the corners colour the face.
        """
        uvs, rows = self.uvs.copy(), np.full(len(self.faces), -1, dtype=np.int32)
        for slot in np.unique(self.paint):
            paint, faces = self.paints[slot], np.flatnonzero(self.paint == slot)
            if paint.placed is not None:
                uvs[faces], rows[faces] = in_images(paint, self.uvs[faces], album)
            elif paint.attribute is None:
                uvs[faces], rows[faces] = 0.5, album.plain(paint.factor, paint.opacity)
        return uvs, rows


@dataclass(frozen=True, slots=True, eq=False)
class _Wearer:
    """What wears the materials: an evaluated object, its mesh, what it tells them, and where remarks go."""

    obj: bpy.types.Object
    mesh: bpy.types.Mesh
    values: ObjectValues
    album: Album


def slot_paints(
    obj: bpy.types.Object, mesh: bpy.types.Mesh, values: ObjectValues, album: Album
) -> tuple[Paint | None, ...]:
    """Find what paints the slots of a mesh.

    Parameters
    ----------
    obj : bpy.types.Object
        Evaluated; its slots say which materials count.
    mesh : bpy.types.Mesh
        Its mesh.
    values : ObjectValues
        What the object tells its materials.
    album : Album
        Takes remarks.

    Returns
    -------
    tuple of (Paint or None)
        One for each slot, at least one; None where the colour must be baked.
        Slots that no face uses are plain.

    """
    wearer, materials = _Wearer(obj, mesh, values, album), slot_materials(obj, mesh)
    used = set(np.unique(_face_slots(mesh, len(materials))).tolist())
    return tuple(
        _slot_paint(material, slot, wearer) if slot in used else Paint() for slot, material in enumerate(materials)
    )


def slot_materials(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> list[bpy.types.Material | None]:
    """Return the material of every slot; one empty slot where there is none."""
    own = [slot.material for slot in obj.material_slots]
    return [*own, *mesh.materials[len(own) :]] or [None]


def read_surface(mesh: bpy.types.Mesh, matrix: Floats, paints: Sequence[Paint]) -> Surface:
    """Read the triangles of a mesh.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        Its loop triangles are computed anew.
    matrix : (4, 4) float64 array
        Object to world. A mirroring one turns the triangles.
    paints : sequence of Paint
        One for each slot.
    """
    mesh.calc_loop_triangles()
    vertices = _numbers(mesh.vertices, "co", 3) @ matrix[:3, :3].T + matrix[:3, 3]
    order = [0, 2, 1] if np.linalg.det(matrix[:3, :3]) < 0 else [0, 1, 2]
    loops = _numbers(mesh.loop_triangles, "loops", 3, np.int32)[:, order]
    paint = _face_slots(mesh, len(paints))
    uvs, corners, coloured = np.zeros((len(loops), 3, 2)), np.zeros((len(loops), 3, 4)), np.zeros(len(loops), bool)
    for slot, own in enumerate(paints):
        faces = paint == slot
        if own.placed is not None and own.placed.uv_map is not None:
            uvs[faces] = _uv_map(mesh, own.placed.uv_map)[loops[faces]]
        elif own.placed is None and own.attribute is not None:
            corners[faces] = _painted_corners(mesh, own)[loops[faces]]
            coloured |= faces
    return Surface(
        vertices=vertices,
        faces=_numbers(mesh.loop_triangles, "vertices", 3, np.int32)[:, order],
        uvs=uvs,
        paint=paint,
        paints=tuple(paints),
        corners=corners[coloured],
    )


def _slot_paint(material: bpy.types.Material | None, slot: int, wearer: _Wearer) -> Paint | None:
    if material is None:
        return Paint(attribute="") if _colour_attribute(wearer.mesh, "") else Paint(factor=(_UNCOLOURED,) * 3)
    try:
        paint = _with_opacity(_without_missing(read_paint(material, wearer.values), material, wearer), slot, wearer)
        if not all(is_readable(texture.image) for texture in textures_of(paint)):
            return None
        if paint.placed is not None:
            return _with_uv_map(_with_attribute(paint, slot, material, wearer), material, wearer)
        _remark_on_hidden(paint, slot, material, wearer)
        return _with_attribute(paint, slot, material, wearer)
    except NotAProduct:
        for image in filter(is_missing, colour_images(material)):
            wearer.album.remark(remark_on_missing(image, material.name))
        return None


def _without_missing(paint: Paint, material: bpy.types.Material, wearer: _Wearer) -> Paint:
    """Return the paint with its plain colour in the place of an image that is missing; what it hid is seen."""
    missing = [texture.image for texture in textures_of(paint) if is_missing(texture.image)]
    for image in missing:
        wearer.album.remark(remark_on_missing(image, material.name))
    if not missing:
        return paint
    seen = replaced(paint.opacity, lambda leaf: 1.0 if leaf[0] == "image" and is_missing(leaf[1].image) else leaf)
    if paint.texture is None or not is_missing(paint.texture.image):
        return replace(paint, opacity=seen)
    plain = paint.bare if paint.factor == (1.0, 1.0, 1.0) and paint.attribute is None else paint.factor
    return replace(paint, opacity=seen, texture=None, factor=plain)


def _remark_on_hidden(paint: Paint, slot: int, material: bpy.types.Material, wearer: _Wearer) -> None:
    """Tell of painted colours that a plain material hides."""
    attribute = _colour_attribute(wearer.mesh, "") if paint.attribute is None else None
    if attribute is None:
        return
    colours = _corner_colours(wearer.mesh, "")[_slot_loops(slot, wearer), :3]
    if len(colours) and np.ptp(colours, axis=0).any():
        wearer.album.remark(
            f"{wearer.obj.name!r} has painted colours, {attribute.name!r}, that its material {material.name!r} does "
            "not show: link them to its base colour, or remove the material."
        )


def _with_opacity(paint: Paint, slot: int, wearer: _Wearer) -> Paint:
    """Return the paint with an opacity that images alone decide, or the corners where they give the colour too."""
    own = replaced(paint.opacity, lambda leaf: _even_alpha(leaf, slot, wearer))
    images = [leaf[1] for leaf in leaves(own) if leaf[0] == "image"]
    if not images:
        varied = not isinstance(own, float)
        if varied and (paint.texture is not None or paint.attribute is None):
            raise NotAProduct
        return replace(paint, opacity=own)
    place = paint.texture or images[0]
    if paint.attribute is not None or len(images) < len(list(leaves(own))) or not all(map(place.lies_as, images)):
        raise NotAProduct
    return replace(paint, opacity=own, mask=None if paint.texture else place)


def _even_alpha(leaf: tuple[Any, ...], slot: int, wearer: _Wearer) -> Expression:
    """Return the alpha of a colour attribute if it is the same all over a slot, else the leaf as it was."""
    if leaf[0] != "attribute":
        return leaf
    attribute = _colour_attribute(wearer.mesh, leaf[1])
    if attribute is None:
        return 1.0
    alpha = _corner_colours(wearer.mesh, leaf[1])[_slot_loops(slot, wearer), 3]
    return float(alpha[0]) if len(alpha) and np.ptp(alpha) == 0 else leaf


def _slot_loops(slot: int, wearer: _Wearer) -> Ints:
    """Return the loops of the triangles of a slot."""
    wearer.mesh.calc_loop_triangles()
    loops = _numbers(wearer.mesh.loop_triangles, "loops", 3, np.int32)
    return loops[_face_slots(wearer.mesh, len(slot_materials(wearer.obj, wearer.mesh))) == slot].ravel()


def _with_uv_map(paint: Paint, material: bpy.types.Material, wearer: _Wearer) -> Paint:
    """Return the paint with a UV map that the mesh has; None if it has no UV map at all."""
    texture, mesh, name = paint.placed, wearer.mesh, wearer.obj.name
    names = [layer.name for layer in mesh.uv_layers]
    if texture.uv_map in names:
        return paint
    if texture.uv_map and texture.uv_map in mesh.attributes:
        raise NotAProduct
    if not names:
        wearer.album.remark(
            f"{name!r} has no UV map for the image of its material {material.name!r}: "
            "the average colour of the image was used."
        )
        return _moved(paint, None)
    active = next((layer.name for layer in mesh.uv_layers if layer.active_render), names[0])
    if texture.uv_map:
        wearer.album.remark(f"{name!r} has no UV map called {texture.uv_map!r}: {active!r} was used.")
    return _moved(paint, active)


def _moved(paint: Paint, uv_map: str | None) -> Paint:
    texture = replace(paint.placed, uv_map=uv_map)
    return replace(paint, texture=texture) if paint.texture else replace(paint, mask=texture)


def _with_attribute(paint: Paint, slot: int, material: bpy.types.Material, wearer: _Wearer) -> Paint:
    """Return the paint with a colour attribute that the mesh has; beside an image only one of a single colour."""
    mesh = wearer.mesh
    if paint.attribute is None:
        return paint
    attribute = _colour_attribute(mesh, paint.attribute)
    if attribute is None and paint.attribute in mesh.attributes:
        raise NotAProduct
    if attribute is None:
        wearer.album.remark(
            f"{wearer.obj.name!r} has no colour attribute {paint.attribute!r} for its material {material.name!r}: "
            "white was used."
        )
        return replace(paint, attribute=None)
    colours = _corner_colours(mesh, paint.attribute)[_slot_loops(slot, wearer), :3]
    if not colours.any():
        wearer.album.remark(
            f"The colour attribute {attribute.name!r} of {wearer.obj.name!r} is black all over and makes the material "
            f"{material.name!r} black: paint it, or unlink it in the material."
        )
    if paint.texture is None:
        return paint
    if np.ptp(colours, axis=0).any():
        raise NotAProduct
    red, green, blue = (colours[0] * paint.factor).tolist()
    return replace(paint, factor=(red, green, blue), attribute=None)


def _painted_corners(mesh: bpy.types.Mesh, paint: Paint) -> Floats:
    """Return linear colour and alpha of every loop."""
    colours = _corner_colours(mesh, paint.attribute)
    alpha = evaluated(paint.opacity, lambda leaf: _corner_colours(mesh, leaf[1])[:, 3])
    return np.column_stack([colours[:, :3] * paint.factor, np.broadcast_to(alpha, len(colours))])


def _face_slots(mesh: bpy.types.Mesh, count: int) -> Ints:
    """Return the slot of every loop triangle; numbers beyond the last slot mean the last one, as in Blender."""
    mesh.calc_loop_triangles()
    if count == 1:
        return np.zeros(len(mesh.loop_triangles), dtype=np.int32)
    return np.clip(_numbers(mesh.loop_triangles, "material_index", 1, np.int32)[:, 0], 0, count - 1)


def _uv_map(mesh: bpy.types.Mesh, name: str) -> Floats:
    return _numbers(mesh.uv_layers[name].uv, "vector", 2)


def _colour_attribute(mesh: bpy.types.Mesh, name: str) -> bpy.types.Attribute | None:
    colours = mesh.color_attributes
    if name:
        return colours.get(name)
    index = colours.render_color_index if colours.render_color_index >= 0 else colours.active_color_index
    return colours[index] if 0 <= index < len(colours) else None


def _corner_colours(mesh: bpy.types.Mesh, name: str) -> Floats:
    """Return linear colour and alpha of every loop; Blender itself decodes the bytes of byte colours."""
    attribute = _colour_attribute(mesh, name)
    colours = _numbers(attribute.data, "color", 4)
    if attribute.domain == "CORNER":
        return colours
    return colours[_numbers(mesh.loops, "vertex_index", 1, np.int32)[:, 0]]


def _numbers(items: bpy.types.bpy_prop_collection, name: str, width: int, kind: type = np.float32) -> np.ndarray:
    """Return a property of all items, shape (n_items, width); floats in double precision."""
    values = np.empty(len(items) * width, dtype=kind)
    items.foreach_get(name, values)
    values = values.reshape(-1, width)
    return values.astype(np.float64) if kind is np.float32 else values
