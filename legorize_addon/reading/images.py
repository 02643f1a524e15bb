"""Blender's images as sRGB bytes, each pixel buffer read once."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.colours import linear_from_srgb, srgb_from_linear
from ..core.errors import MeshError
from .colours import Bytes, Floats
from .expressions import Expression, evaluated
from .textures import Texture

_LINEAR: Final = ("Linear Rec.709", "Linear", "Non-Color", "Raw")
_LINEAR_BYTES: Final = linear_from_srgb(np.arange(256, dtype=np.uint8)).astype(np.float32)
LARGEST_SIDE: Final = 4096
"""Texels along a side; a larger image is halved. At 16 texels a stud, the most that matter, this is 256 studs."""

_ROWS: Final = 256
"""Rows of an image that are decoded at once."""


class Album:
    """The images of a mesh, gathered while it is read; every image enters once.

    Attributes
    ----------
    images : list of (h, w, 3) uint8 arrays
        sRGB; row 0 is the bottom.
    clamp : list of bool
        Whether coordinates outside an image take its edge texel.
    opacities : list of ((h, w) uint8 array or None)
        Alpha of the texels, 255 for opaque; None where all are.
    remarks : list of str
        What could not be taken literally.
    """

    def __init__(self) -> None:
        self.images: list[Bytes] = []
        self.clamp: list[bool] = []
        self.opacities: list[Bytes | None] = []
        self.remarks: list[str] = []
        self._rows: dict[object, int] = {}
        self._pixels: dict[object, tuple[Bytes, Bytes]] = {}

    def remark(self, sentence: str) -> None:
        """Note a sentence for the user, once."""
        if sentence not in self.remarks:
            self.remarks.append(sentence)

    def add(self, image: Bytes, *, clamp: bool, opacity: Bytes | None = None) -> int:
        """Take in an image and return its row."""
        self.images.append(np.ascontiguousarray(image))
        self.clamp.append(clamp)
        self.opacities.append(None if opacity is None or opacity.min() == 255 else np.ascontiguousarray(opacity))
        return len(self.images) - 1

    def plain(self, linear: tuple[float, float, float] | Floats, opacity: float = 1.0) -> int:
        """Return the row of a plain colour, given as linear RGB."""
        colour = srgb_from_linear(np.asarray(linear, dtype=float))
        key = (colour.tobytes(), opacity)
        if key not in self._rows:
            alpha = _bytes(np.full((1, 1), opacity))
            self._rows[key] = self.add(colour[None, None], clamp=True, opacity=alpha)
        return self._rows[key]

    def textured(
        self,
        texture: Texture,
        factor: tuple[float, float, float],
        tile: int = 0,
        *,
        opacity: Expression = 1.0,
        blank: bool = False,
    ) -> int:
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
        opacity : Expression
            How much of the texels is seen; its leaves are images that lie as this one.
        blank : bool
            Whether the image is only as large as the texture, in one colour.

        Returns
        -------
        int
            The same for the same arguments.
        """
        key = (texture.image.session_uid, texture.wrap, factor, tile, opacity, blank)
        if key not in self._rows:
            colours, _ = self._texels(texture, tile)
            colours = _multiplied(np.full_like(colours, 255) if blank else colours, factor)
            alpha = self._opacity(opacity, tile, colours.shape[:2])
            if texture.wrap == "MIRROR":
                colours, alpha = _mirrored(colours), None if alpha is None else _mirrored(alpha)
            self._rows[key] = self.add(colours, clamp=texture.wrap in ("EXTEND", "CLIP"), opacity=alpha)
        return self._rows[key]

    def average(self, texture: Texture, factor: tuple[float, float, float]) -> int:
        """Return the row of the average colour of an image, for surfaces without image coordinates."""
        colours, _ = self._texels(texture, 0)
        count = np.stack([np.bincount(colours[..., channel].ravel(), minlength=256) for channel in range(3)], axis=1)
        mean = linear_from_srgb(np.arange(256, dtype=np.uint8)) @ count / (colours.shape[0] * colours.shape[1])
        return self.plain(mean * factor)

    def _opacity(self, opacity: Expression, tile: int, shape: tuple[int, int]) -> Bytes | None:
        """Return how much is seen of the texels of an image."""
        if opacity == 1.0:
            return None
        found = evaluated(opacity, lambda leaf: _resized(_channel(*self._texels(leaf[1], tile), leaf[2]), shape))
        return _bytes(np.broadcast_to(found, shape))

    def _texels(self, texture: Texture, tile: int) -> tuple[Bytes, Bytes]:
        key = (texture.image.session_uid, tile)
        if key not in self._pixels:
            self._pixels[key] = self._read(texture.image, tile)
        return self._pixels[key]

    def _read(self, image: bpy.types.Image, tile: int) -> tuple[Bytes, Bytes]:
        step = step_of(image)
        if step > 1:
            self.remark(
                f"The image {image.name!r} is larger than {LARGEST_SIDE} texels: it was used at 1/{step} of its size."
            )
        if tile == 0:
            return read_pixels(image)
        # Blender hands out the pixels of the first tile only
        single = bpy.data.images.load(_tile_path(image, tile))
        try:
            single.colorspace_settings.name = image.colorspace_settings.name
            return read_pixels(single)
        finally:
            bpy.data.images.remove(single)


def is_missing(image: bpy.types.Image | None) -> bool:
    """Return whether an image has no pixels: there is none, or its file is missing or cannot be read."""
    if image is None:
        return True
    tiles = image.tiles if image.source == "TILED" and not image.packed_files else ()
    return 0 in image.size or not all(Path(_tile_path(image, tile.number)).is_file() for tile in tiles)


def remark_on_missing(image: bpy.types.Image | None, material: str) -> str:
    """Return a sentence on an image that is missing.

    Parameters
    ----------
    image : bpy.types.Image or None
        The image of a node.
    material : str
        Name of the material.

    Returns
    -------
    str
    """
    if image is None:
        return (
            f"The material {material!r} has an image texture without an image: its plain colour was used; choose an "
            "image for it."
        )
    return (
        f"The material {material!r} needs the image file {image.filepath or image.name!r}, which is missing or "
        "cannot be read: its plain colour was used; put the file there, or choose another image."
    )


def is_readable(image: bpy.types.Image) -> bool:
    """Return whether the pixels can be had as sRGB; else only Cycles knows the colour space or reads the tiles."""
    linear = image.is_float or image.colorspace_settings.is_data
    known = linear or image.colorspace_settings.name in ("sRGB", *_LINEAR)
    return known and not (image.source == "TILED" and len(image.packed_files))


def read_pixels(image: bpy.types.Image) -> tuple[Bytes, Bytes]:
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
    (h, w) uint8 array
        Alpha.
    """
    try:
        with _no_larger(image) as small:
            return _decoded(small)
    except MemoryError as error:
        width, height = image.size
        raise MeshError(
            f"The image {image.name!r} of {width} x {height} texels does not fit in memory: use a smaller copy of it."
        ) from error


@contextmanager
def _no_larger(image: bpy.types.Image) -> Iterator[bpy.types.Image]:
    """Yield a temporary copy of a large image that Blender reduced to fewer bytes before they become numbers.

    Pixels that are in memory alone, painted or generated, are no copy's: those images are yielded as they are.
    """
    step = step_of(image)
    if step == 1 or image.is_dirty or image.source != "FILE":
        yield image
        return
    copy = image.copy()
    try:
        copy.scale(max(1, image.size[0] // step), max(1, image.size[1] // step))
        yield copy
    finally:
        bpy.data.images.remove(copy)


def step_of(image: bpy.types.Image) -> int:
    """Return to which part of its size an image is reduced, along both sides."""
    return 1 << max(0, math.ceil(math.log2(max(*image.size, 1) / LARGEST_SIDE)))


def _decoded(image: bpy.types.Image) -> tuple[Bytes, Bytes]:
    """Return sRGB and alpha of an image, of one in memory that is too large every second texel or fewer."""
    (width, height), step = image.size, step_of(image)
    buffer = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(buffer)
    values = buffer.reshape(height, width, image.channels)[::step, ::step]
    colours, alpha = np.empty((*values.shape[:2], 3), np.uint8), np.full(values.shape[:2], 255, np.uint8)
    linear = image.is_float or image.colorspace_settings.is_data or image.colorspace_settings.name in _LINEAR
    # in parts: numbers take many times the memory of bytes
    for first in range(0, len(values), _ROWS):
        rows = slice(first, first + _ROWS)
        part = values[rows, :, :3] if image.channels >= 3 else values[rows, :, :1]
        colours[rows] = srgb_from_linear(np.nan_to_num(part)) if linear else np.rint(part * 255.0)
        if image.channels in (2, 4):
            alpha[rows] = _bytes(values[rows, :, -1])
    return colours, alpha


def _tile_path(image: bpy.types.Image, tile: int) -> str:
    column, row = (tile - 1001) % 10, (tile - 1001) // 10
    path = bpy.path.abspath(image.filepath, library=image.library)
    return path.replace("<UDIM>", str(tile)).replace("<UVTILE>", f"u{column + 1}_v{row + 1}")


def _multiplied(colours: Bytes, factor: tuple[float, float, float]) -> Bytes:
    if factor == (1.0, 1.0, 1.0):
        return colours
    table = srgb_from_linear(linear_from_srgb(np.arange(256, dtype=np.uint8))[:, None] * factor)
    return np.stack([table[colours[..., channel], channel] for channel in range(3)], axis=-1)


def _mirrored(texels: Bytes) -> Bytes:
    """Return an image with its mirror images to the right and above."""
    texels = np.concatenate([texels, texels[:, ::-1]], axis=1)
    return np.concatenate([texels, texels[::-1]], axis=0)


def _channel(colours: Bytes, alpha: Bytes, name: str) -> NDArray[np.float32]:
    """Return what an image tells in one number a texel, 0 to 1."""
    if name == "alpha":
        return alpha.astype(np.float32) / 255
    if name == "least":
        return _LINEAR_BYTES[colours.min(axis=2)]
    weights = {"red": (1, 0, 0), "green": (0, 1, 0), "blue": (0, 0, 1), "brightness": (0.2126, 0.7152, 0.0722)}[name]
    total: NDArray[np.float32] = sum(
        np.float32(weight) * _LINEAR_BYTES[colours[..., row]] for row, weight in enumerate(weights) if weight
    )
    return total


def _resized(values: NDArray[np.float32], shape: tuple[int, int]) -> NDArray[np.float32]:
    """Return the nearest texels for an image of another size that lies in the same place."""
    if values.shape == shape:
        return values
    row, column = ((np.arange(n) * own) // n for n, own in zip(shape, values.shape, strict=True))
    return values[row[:, None], column]


def _bytes(share: NDArray[np.floating]) -> Bytes:
    return np.rint(np.clip(np.nan_to_num(share), 0.0, 1.0) * 255.0).astype(np.uint8)
