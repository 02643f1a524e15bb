"""Where faces lie in the images of their paint: mappings, UDIM tiles, coordinates that are no numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .colours import Floats
from .images import Album
from .materials import Paint

Ints = NDArray[np.int32]


def in_images(paint: Paint, uvs: Floats, album: Album) -> tuple[Floats, Ints]:
    """Find where faces lie in the images of their paint.

    Parameters
    ----------
    paint : Paint
        Has an image.
    uvs : (k, 3, 2) float64 array
        Coordinates of its UV map at the corners of the faces.
    album : Album
        Takes the images, and remarks.

    Returns
    -------
    (k, 3, 2) float64 array
        Coordinates in the images.
    (k,) int32 array
        Rows in the album.
    """
    texture = paint.placed
    if texture.uv_map is None:
        return np.full_like(uvs, 0.5), np.full(len(uvs), _average(paint, album), dtype=np.int32)
    known = np.isfinite(uvs).all(axis=(1, 2))
    if not known.all():
        return _beside_unknown(paint, uvs, known, album)
    mapping = np.array(texture.mapping)
    uvs = uvs @ mapping[:, :2].T + mapping[:, 2]
    if texture.image.source == "TILED":
        return _in_tiles(paint, uvs, album)
    row = _row(paint, album)
    return uvs / 2 if texture.wrap == "MIRROR" else uvs, np.full(len(uvs), row, dtype=np.int32)


def _row(paint: Paint, album: Album, tile: int = 0) -> int:
    blank = paint.texture is None
    return album.textured(paint.placed, paint.factor, tile, opacity=paint.opacity, blank=blank)


def _average(paint: Paint, album: Album) -> int:
    return album.plain(paint.factor) if paint.texture is None else album.average(paint.texture, paint.factor)


def _beside_unknown(paint: Paint, uvs: Floats, known: np.ndarray, album: Album) -> tuple[Floats, Ints]:
    """Give the average colour to faces whose image coordinates are no numbers."""
    count, name = np.count_nonzero(~known), paint.placed.image.name
    album.remark(
        f"{count} {'triangle has' if count == 1 else 'triangles have'} image coordinates on {name!r} that are not "
        "finite numbers: the average colour of the image was used; unwrap the mesh again."
    )
    found, rows = np.full_like(uvs, 0.5), np.full(len(uvs), _average(paint, album), dtype=np.int32)
    if known.any():
        found[known], rows[known] = in_images(paint, uvs[known], album)
    return found, rows


def _in_tiles(paint: Paint, uvs: Floats, album: Album) -> tuple[Floats, Ints]:
    """Give every face the UDIM tile that its middle lies in, the first tile where there is none."""
    image = paint.placed.image
    place = np.floor(uvs.mean(axis=1)).astype(int)
    number = 1001 + place[:, 0] + 10 * place[:, 1]
    rows = np.full(len(uvs), -1, dtype=np.int32)
    for tile in image.tiles:
        faces = number == tile.number
        if faces.any():
            rows[faces] = _row(paint, album, tile.number)
    if (rows < 0).any():
        album.remark(f"Some faces lie outside the tiles of the image {image.name!r}: its first tile was used.")
        rows[rows < 0] = _row(paint, album, image.tiles[0].number)
    return uvs - place[:, None], rows
