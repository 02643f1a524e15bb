"""Looking at an image before Blender opens it: whether it can be, and how a camera was held.

References
----------
W3C, "Portable Network Graphics (PNG) Specification", third edition (2025):
chunks, eXIf. ITU-T T.81 (1992), appendix B: markers of JPEG. CIPA DC-008, "Exif",
version 2.32: orientation, tag 274.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import MeshError
from .damage import damaged

PICTURES: Final = (".png", ".jpg", ".jpeg")
"""Kinds of files that become mosaics."""

_PNG: Final = b"\x89PNG\r\n\x1a\n"
_JPEG: Final = b"\xff\xd8"
_EXIF: Final = b"Exif\x00\x00"
_ORIENTATION: Final = 274
_FRAMES: Final = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
"""JPEG markers that begin a frame, whose head has its size and its number of channels."""

_ALONE: Final = frozenset({0x01, *range(0xD0, 0xD9)})
"""JPEG markers without a length."""

_HEAD: Final = 1 << 20
"""Bytes of a file in which its head is looked for."""


class PictureHead(NamedTuple):
    """What the head of an image file says.

    Attributes
    ----------
    size : (int, int)
        Width and height in pixels, as they are stored.
    orientation : int
        How to turn them, 1 to 8 as Exif counts.
    """

    size: tuple[int, int]
    orientation: int

    def upright(self, pixels: NDArray[np.generic]) -> NDArray[np.generic]:
        """Turn stored pixels, rows from the bottom, (h, w, ...), as the camera was held."""
        rows = pixels[::-1]
        if self.orientation in (5, 6, 7, 8):
            rows = rows.swapaxes(0, 1)
        # after the exchange of rows and columns: which of them run the other way
        if self.orientation in (3, 4, 7, 8):
            rows = rows[::-1]
        if self.orientation in (2, 3, 6, 7):
            rows = rows[:, ::-1]
        return np.ascontiguousarray(rows[::-1])


def check_picture(source: Path) -> PictureHead:
    """Look at an image before it is opened.

    Parameters
    ----------
    source : Path
        A .png or .jpg file.

    Returns
    -------
    PictureHead

    Raises
    ------
    MeshError
        It is certain that it cannot be read, or its colours are inks.
    """
    try:
        with source.open("rb") as file:
            head = file.read(_HEAD)
    except OSError as error:
        raise MeshError(f"{source.name} cannot be read ({error.strerror}): check its access rights.") from error
    if head.startswith(_PNG):
        return _png(source, head)
    if head.startswith(_JPEG):
        return _jpeg(source, head)
    raise MeshError(f"{source.name} is neither a PNG nor a JPEG image, whatever its name says: save it as one of them.")


def _png(source: Path, head: bytes) -> PictureHead:
    size, turned = None, 1
    for kind, content in _chunks(head):
        if kind == b"IHDR" and len(content) == 13:
            width, height = struct.unpack(">II", content[:8])
            size = int(width), int(height)
        elif kind == b"eXIf":
            turned = _orientation(content)
    if size is None or 0 in size:
        raise damaged(source, "its header says no size")
    return PictureHead(size, turned)


def _chunks(head: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield kind and content of the chunks before the pixels, and of those after them that lie in the head."""
    at = len(_PNG)
    while at + 8 <= len(head):
        length, kind = struct.unpack(">I4s", head[at : at + 8])
        yield kind, head[at + 8 : at + 8 + length]
        at += 12 + length


def _jpeg(source: Path, head: bytes) -> PictureHead:
    turned = 1
    for marker, content in _segments(head):
        if marker == 0xE1 and content.startswith(_EXIF):
            turned = _orientation(content[len(_EXIF) :])
        elif marker in _FRAMES and len(content) >= 6:
            bits, height, width, channels = struct.unpack(">BHHB", content[:6])
            if channels == 4:
                raise MeshError(f"{source.name} has the four inks of a print (CMYK): save it as RGB.")
            if bits != 8:
                raise MeshError(f"{source.name} has {bits} bits a channel, which few programs read: save it with 8.")
            if 0 in (width, height):
                raise damaged(source, "its header says no size")
            return PictureHead((width, height), turned)
    raise damaged(source, "its header has no end")


def _segments(head: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield marker and content of the segments of a JPEG file."""
    at = 2
    while at + 4 <= len(head) and head[at] == 0xFF:
        marker = head[at + 1]
        if marker == 0xFF:
            at += 1
        elif marker in _ALONE:
            at += 2
        else:
            length = int.from_bytes(head[at + 2 : at + 4], "big")
            yield marker, head[at + 4 : at + 2 + length]
            at += 2 + max(length, 2)


def _orientation(exif: bytes) -> int:
    """Return how Exif data say that the pixels are to be turned; 1 if they do not, or are damaged."""
    order = {b"II": "<", b"MM": ">"}.get(exif[:2])
    if order is None or len(exif) < 8:
        return 1
    (at,) = struct.unpack(order + "I", exif[4:8])
    if at + 2 > len(exif):
        return 1
    (count,) = struct.unpack(order + "H", exif[at : at + 2])
    for entry in range(at + 2, min(at + 2 + 12 * count, len(exif) - 11), 12):
        tag, kind, number, value = struct.unpack(order + "HHIH", exif[entry : entry + 10])
        if (tag, kind, number) == (_ORIENTATION, 3, 1):
            return value if 1 <= value <= 8 else 1
    return 1
