"""The triangles of one evaluated mesh, and what paints each of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import bpy
import numpy as np
from numpy.typing import NDArray

from .core.colour_difference import linear_from_srgb
from .node_links import NotAProduct
from .read_colours import Floats
from .read_images import Album, check_image, is_readable
from .read_materials import Paint, Texture, colour_images, read_paint

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
    corners : (k, 3, 3) float64 array
        Linear colours of the corners of the faces whose paint has an attribute, in the order of the faces.
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
            if paint.texture is not None:
                uvs[faces], rows[faces] = _in_images(paint.texture, paint.factor, self.uvs[faces], album)
            elif paint.attribute is None:
                uvs[faces], rows[faces] = 0.5, album.plain(paint.factor)
        return uvs, rows


def slot_paints(obj: bpy.types.Object, mesh: bpy.types.Mesh, album: Album) -> tuple[Paint | None, ...]:
    """Find what paints the slots of a mesh.

    Parameters
    ----------
    obj : bpy.types.Object
        Evaluated; its slots say which materials count.
    mesh : bpy.types.Mesh
        Its mesh.
    album : Album
        Takes remarks.

    Returns
    -------
    tuple of (Paint or None)
        One for each slot, at least one; None where the colour must be baked.
        Slots that no face uses are plain.

    Raises
    ------
    MeshError
        If an image is missing.
    """
    used = set(np.unique(_face_slots(mesh, len(slot_materials(obj, mesh)))).tolist())
    return tuple(
        _slot_paint(material, slot, obj, mesh, album) if slot in used else Paint()
        for slot, material in enumerate(slot_materials(obj, mesh))
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
    uvs, corners, coloured = np.zeros((len(loops), 3, 2)), np.zeros((len(loops), 3, 3)), np.zeros(len(loops), bool)
    for slot, own in enumerate(paints):
        faces = paint == slot
        if own.texture is not None and own.texture.uv_map is not None:
            uvs[faces] = _uv_map(mesh, own.texture.uv_map)[loops[faces]]
        elif own.texture is None and own.attribute is not None:
            corners[faces] = _corner_colours(mesh, own.attribute)[loops[faces]] * own.factor
            coloured |= faces
    return Surface(
        vertices=vertices,
        faces=_numbers(mesh.loop_triangles, "vertices", 3, np.int32)[:, order],
        uvs=np.nan_to_num(uvs),
        paint=paint,
        paints=tuple(paints),
        corners=corners[coloured],
    )


def _slot_paint(
    material: bpy.types.Material | None, slot: int, obj: bpy.types.Object, mesh: bpy.types.Mesh, album: Album
) -> Paint | None:
    if material is None:
        return Paint(attribute="") if _colour_attribute(mesh, "") else Paint(factor=(_UNCOLOURED,) * 3)
    try:
        paint = read_paint(material)
        if paint.texture is not None:
            check_image(paint.texture.image, material.name)
            if not is_readable(paint.texture.image):
                return None
            paint = replace(paint, texture=_with_uv_map(paint.texture, material, obj, mesh, album))
        return paint if paint.attribute is None else _with_attribute(paint, slot, material, obj, mesh, album)
    except NotAProduct:
        for image in colour_images(material):
            check_image(image, material.name)
        return None


def _with_uv_map(
    texture: Texture, material: bpy.types.Material, obj: bpy.types.Object, mesh: bpy.types.Mesh, album: Album
) -> Texture:
    """Return the texture with a UV map that the mesh has; None if it has no UV map at all."""
    names = [layer.name for layer in mesh.uv_layers]
    if texture.uv_map in names:
        return texture
    if texture.uv_map and texture.uv_map in mesh.attributes:
        raise NotAProduct
    if not names:
        album.remark(
            f"{obj.name!r} has no UV map for the image of its material {material.name!r}: "
            "the average colour of the image was taken."
        )
        return replace(texture, uv_map=None)
    active = next((layer.name for layer in mesh.uv_layers if layer.active_render), names[0])
    if texture.uv_map:
        album.remark(f"{obj.name!r} has no UV map called {texture.uv_map!r}: {active!r} was taken.")
    return replace(texture, uv_map=active)


def _with_attribute(
    paint: Paint, slot: int, material: bpy.types.Material, obj: bpy.types.Object, mesh: bpy.types.Mesh, album: Album
) -> Paint:
    """Return the paint with a colour attribute that the mesh has; beside an image only one of a single colour."""
    attribute = _colour_attribute(mesh, paint.attribute)
    if attribute is None and paint.attribute in mesh.attributes:
        raise NotAProduct
    if attribute is None:
        album.remark(
            f"{obj.name!r} has no colour attribute {paint.attribute!r} for its material {material.name!r}: "
            "white was taken."
        )
        return replace(paint, attribute=None)
    if paint.texture is None:
        return paint
    mesh.calc_loop_triangles()
    loops = _numbers(mesh.loop_triangles, "loops", 3, np.int32)
    faces = _face_slots(mesh, len(slot_materials(obj, mesh))) == slot
    colours = _corner_colours(mesh, paint.attribute)[loops[faces]].reshape(-1, 3)
    if np.ptp(colours, axis=0).any():
        raise NotAProduct
    red, green, blue = (colours[0] * paint.factor).tolist()
    return replace(paint, factor=(red, green, blue), attribute=None)


def _in_images(texture: Texture, factor: tuple[float, float, float], uvs: Floats, album: Album) -> tuple[Floats, Ints]:
    """Return coordinates in the images of a texture, and the images' rows."""
    if texture.uv_map is None:
        return np.full_like(uvs, 0.5), np.full(len(uvs), album.average(texture, factor), dtype=np.int32)
    mapping = np.array(texture.mapping)
    uvs = uvs @ mapping[:, :2].T + mapping[:, 2]
    if texture.image.source == "TILED":
        return _in_tiles(texture, factor, uvs, album)
    row = album.textured(texture, factor)
    return uvs / 2 if texture.wrap == "MIRROR" else uvs, np.full(len(uvs), row, dtype=np.int32)


def _in_tiles(texture: Texture, factor: tuple[float, float, float], uvs: Floats, album: Album) -> tuple[Floats, Ints]:
    """Give every face the UDIM tile that its middle lies in, the first tile where there is none."""
    place = np.floor(uvs.mean(axis=1)).astype(int)
    number = 1001 + place[:, 0] + 10 * place[:, 1]
    rows = np.full(len(uvs), -1, dtype=np.int32)
    for tile in texture.image.tiles:
        faces = number == tile.number
        if faces.any():
            rows[faces] = album.textured(texture, factor, tile.number)
    if (rows < 0).any():
        album.remark(f"Some faces lie outside the tiles of the image {texture.image.name!r}: its first tile was taken.")
        rows[rows < 0] = album.textured(texture, factor, texture.image.tiles[0].number)
    return uvs - place[:, None], rows


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
    """Return the linear colour of every loop; Blender itself decodes the bytes of byte colours."""
    attribute = _colour_attribute(mesh, name)
    colours = _numbers(attribute.data, "color", 4)[:, :3]
    if attribute.domain == "CORNER":
        return colours
    return colours[_numbers(mesh.loops, "vertex_index", 1, np.int32)[:, 0]]


def _numbers(items: bpy.types.bpy_prop_collection, name: str, width: int, kind: type = np.float32) -> np.ndarray:
    """Return a property of all items, shape (n_items, width); floats in double precision."""
    values = np.empty(len(items) * width, dtype=kind)
    items.foreach_get(name, values)
    values = values.reshape(-1, width)
    return values.astype(np.float64) if kind is np.float32 else values
