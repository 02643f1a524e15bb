"""Blender's images as sRGB bytes, each pixel buffer read once."""

from __future__ import annotations

from pathlib import Path
from typing import Final

import bpy
import numpy as np
from numpy.typing import NDArray

from .core.colour_difference import linear_from_srgb
from .core.errors import MeshError
from .read_colours import Bytes, Floats, srgb_from_linear
from .read_materials import Texture

_LINEAR: Final = ("Linear Rec.709", "Linear", "Non-Color", "Raw")
LARGEST_SIDE: Final = 8192
"""Texels along a side; of a larger image every second one in both directions is taken."""


class Album:
    """The images of a mesh, gathered while it is read; every image enters once.

    Attributes
    ----------
    images : list of (h, w, 3) uint8 arrays
        sRGB; row 0 is the bottom.
    clamp : list of bool
        Whether coordinates outside an image take its edge texel.
    remarks : list of str
        What could not be taken literally.
    """

    def __init__(self) -> None:
        self.images: list[Bytes] = []
        self.clamp: list[bool] = []
        self.remarks: list[str] = []
        self._rows: dict[object, int] = {}
        self._pixels: dict[object, tuple[Bytes, NDArray[np.bool_]]] = {}

    def remark(self, sentence: str) -> None:
        """Note a sentence for the user, once."""
        if sentence not in self.remarks:
            self.remarks.append(sentence)

    def add(self, image: Bytes, *, clamp: bool) -> int:
        """Take in an image and return its row."""
        self.images.append(np.ascontiguousarray(image))
        self.clamp.append(clamp)
        return len(self.images) - 1

    def plain(self, linear: tuple[float, float, float] | Floats) -> int:
        """Return the row of a plain colour, given as linear RGB."""
        colour = srgb_from_linear(np.asarray(linear, dtype=float))
        key = colour.tobytes()
        if key not in self._rows:
            self._rows[key] = self.add(colour[None, None], clamp=True)
        return self._rows[key]

    def textured(self, texture: Texture, factor: tuple[float, float, float], tile: int = 0) -> int:
        """Return the row of an image multiplied by a linear colour.

        Parameters
        ----------
        texture : Texture
            The image and how it is wrapped. A mirrored image enters doubled in
            both directions, so that its coordinates have to be halved.
        factor : 3 floats
            Linear RGB.
        tile : int
            UDIM number, 0 for an image without tiles.

        Returns
        -------
        int
            The same for the same arguments.
        """
        key = (texture.image.session_uid, texture.wrap, texture.cutout, factor, tile)
        if key not in self._rows:
            colours = _multiplied(self._colours(texture, tile), factor)
            if texture.wrap == "MIRROR":
                colours = np.concatenate([colours, colours[:, ::-1]], axis=1)
                colours = np.concatenate([colours, colours[::-1]], axis=0)
            self._rows[key] = self.add(colours, clamp=texture.wrap in ("EXTEND", "CLIP"))
        return self._rows[key]

    def average(self, texture: Texture, factor: tuple[float, float, float]) -> int:
        """Return the row of the average colour of an image, for surfaces without image coordinates."""
        return self.plain(linear_from_srgb(self._colours(texture, 0)).mean(axis=(0, 1)) * factor)

    def _colours(self, texture: Texture, tile: int) -> Bytes:
        key = (texture.image.session_uid, tile)
        if key not in self._pixels:
            self._pixels[key] = self._read(texture.image, tile)
        colours, seen = self._pixels[key]
        return _filled(colours, seen) if texture.cutout else colours

    def _read(self, image: bpy.types.Image, tile: int) -> tuple[Bytes, NDArray[np.bool_]]:
        if max(image.size) > LARGEST_SIDE:
            self.remark(f"The image {image.name!r} is larger than {LARGEST_SIDE} texels: every second one was taken.")
        if tile == 0:
            return read_pixels(image)
        # Blender hands out the pixels of the first tile only
        single = bpy.data.images.load(_tile_path(image, tile))
        try:
            single.colorspace_settings.name = image.colorspace_settings.name
            return read_pixels(single)
        finally:
            bpy.data.images.remove(single)


def check_image(image: bpy.types.Image | None, material: str) -> None:
    """Refuse an image that has no pixels.

    Parameters
    ----------
    image : bpy.types.Image or None
        The image of a node.
    material : str
        Name of the material, for the sentence.

    Raises
    ------
    MeshError
        If there is no image, or its file is missing or cannot be read.
    """
    if image is None:
        raise MeshError(f"The material {material!r} has an image texture without an image: choose an image for it.")
    tiles = image.tiles if image.source == "TILED" and not image.packed_files else ()
    if 0 in image.size or not all(Path(_tile_path(image, tile.number)).is_file() for tile in tiles):
        raise MeshError(
            f"The material {material!r} needs the image file {image.filepath or image.name!r}, which is missing or "
            "cannot be read: put it there, or choose another image."
        )


def is_readable(image: bpy.types.Image) -> bool:
    """Return whether the pixels can be had as sRGB; else only Cycles knows the colour space or reads the tiles."""
    linear = image.is_float or image.colorspace_settings.is_data
    known = linear or image.colorspace_settings.name in ("sRGB", *_LINEAR)
    return known and not (image.source == "TILED" and len(image.packed_files))


def read_pixels(image: bpy.types.Image) -> tuple[Bytes, NDArray[np.bool_]]:
    """Read the pixels of an image.

    Parameters
    ----------
    image : bpy.types.Image
        Byte images give their stored bytes (converted where they hold linear
        values); float images are linear and are cut to [0, 1].

    Returns
    -------
    (h, w, 3) uint8 array
        sRGB; row 0 is the bottom.
    (h, w) bool array
        Where alpha is at least a half.
    """
    width, height = image.size
    buffer = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(buffer)
    step = 2 if max(width, height) > LARGEST_SIDE else 1
    values = buffer.reshape(height, width, image.channels)[::step, ::step]
    colours = values[..., :3] if image.channels >= 3 else np.repeat(values[..., :1], 3, axis=2)
    seen = values[..., -1] >= 0.5 if image.channels in (2, 4) else np.ones(values.shape[:2], dtype=bool)
    if image.is_float or image.colorspace_settings.is_data or image.colorspace_settings.name in _LINEAR:
        return srgb_from_linear(np.nan_to_num(colours)), seen
    return np.rint(colours * 255.0).astype(np.uint8), seen


def _tile_path(image: bpy.types.Image, tile: int) -> str:
    column, row = (tile - 1001) % 10, (tile - 1001) // 10
    path = bpy.path.abspath(image.filepath, library=image.library)
    return path.replace("<UDIM>", str(tile)).replace("<UVTILE>", f"u{column + 1}_v{row + 1}")


def _multiplied(colours: Bytes, factor: tuple[float, float, float]) -> Bytes:
    if factor == (1.0, 1.0, 1.0):
        return colours
    table = srgb_from_linear(linear_from_srgb(np.arange(256, dtype=np.uint8))[:, None] * factor)
    return np.stack([table[colours[..., channel], channel] for channel in range(3)], axis=-1)


def _filled(colours: Bytes, seen: NDArray[np.bool_]) -> Bytes:
    """Return the colours with the average of what is seen where nothing is seen."""
    if seen.all() or not seen.any():
        return colours
    average = srgb_from_linear(linear_from_srgb(colours[seen]).mean(axis=0))
    return np.where(seen[..., None], colours, average)
