"""Supports as boxes of cells, before they are bricks.

A box is a row ``(x, y, z, length along x, length along y, height)``: its lowest
corner in studs and plates, and its size in the same.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..model import Bricks, Catalogue, Role
from ..units import PLATES_PER_BRICK

Boxes = NDArray[np.int32]

Area = tuple[int, int, int, int]
"""Columns of a brick: lowest x and y, and its lengths along x and y."""

OUTSIDE_COLOUR: Final = 15
"""White, the paper's colour of supports that are taken out again."""

INSIDE_COLOUR: Final = 4
"""Red, the paper's colour of supports that stay inside."""

TALL: Final = 3 * PLATES_PER_BRICK
"""Height of a tall brick in plates."""

_PAPER: Final = (
    *(
        (length, width, PLATES_PER_BRICK)
        for width, lengths in ((1, (1, 2, 3, 4, 6, 8)), (2, (2, 3, 4, 6, 8)))
        for length in lengths
    ),
    *((length, 2, TALL) for length in (2, 4)),
    (1, 1, 1),
)
"""Longer side, shorter side and height of what supports are made of in the paper: eleven bricks, the two of eight studs
that its chassis lies on, and the plate of one stud, without which no contact between whole bricks is reached."""


def boxes_of(rows: Iterable[tuple[int, int, int, int, int, int]]) -> Boxes:
    """Return rows as an array, (n, 6) int32."""
    return np.array(list(rows), dtype=np.int32).reshape(-1, 6)


def cells_of(area: Area) -> list[tuple[int, int]]:
    """Return the columns (x, y) of an area, row by row."""
    x, y, a, b = area
    return [(x + i, y + j) for j in range(b) for i in range(a)]


def sizes_in(catalogue: Catalogue, colour: int) -> dict[tuple[int, int, int], int]:
    """Return the rows of all parts but corners that are made in a colour, by (longer side, shorter side, height)."""
    made = catalogue.exists_in(np.arange(len(catalogue.parts)), colour)
    return {
        (part.length, part.width, part.height): row
        for row, part in enumerate(catalogue.parts)
        if made[row] and part.use == "model" and not part.corner
    }


def of_the_paper(catalogue: Catalogue) -> Catalogue:
    """Return a catalogue in which only those parts can be had that supports are made of in the paper.

    Parameters
    ----------
    catalogue : Catalogue

    Returns
    -------
    Catalogue
        With the same parts and colours.

    References
    ----------
    Paper, section on segmentation (the three types of bricks) and on supports (the chassis).
    """
    kept = [
        (part.length, part.width, part.height) in _PAPER and part.use == "model" and not part.corner
        for part in catalogue.parts
    ]
    return replace(catalogue, exists=catalogue.exists & np.array(kept)[:, None])


def split_missing(boxes: Boxes, sizes: Collection[tuple[int, int, int]]) -> Boxes:
    """Put smaller boxes in place of those for which there is no part.

    Parameters
    ----------
    boxes : (n, 6) int32 array
    sizes : collection of (int, int, int)
        Longer side, shorter side and height of the parts there are, 1 x 1 bricks among them.

    Returns
    -------
    (m, 6) int32 array
        The same array if every box has its part. A tall box becomes three, another one two halves of its longer side,
        again and again.
    """
    if all((max(a, b), min(a, b), height) in sizes for _, _, _, a, b, height in boxes.tolist()):
        return boxes
    done, left = [], boxes.tolist()[::-1]
    while left:
        x, y, z, a, b, height = box = left.pop()
        if (max(a, b), min(a, b), height) in sizes or (a == b == 1 and height != TALL):
            done.append(tuple(box))
        elif height == TALL:
            left += [[x, y, z + PLATES_PER_BRICK * step, a, b, PLATES_PER_BRICK] for step in (2, 1, 0)]
        elif a >= b:
            left += [[x + a // 2, y, z, a - a // 2, b, height], [x, y, z, a // 2, b, height]]
        else:
            left += [[x, y + b // 2, z, a, b - b // 2, height], [x, y, z, a, b // 2, height]]
    return boxes_of(done)


def merge_upwards(boxes: Boxes, catalogue: Catalogue, colour: int) -> Boxes:
    """Put one tall brick in place of three that stand on each other.

    Parameters
    ----------
    boxes : (n, 6) int32 array
    catalogue : Catalogue
    colour : int
        In which the tall part must be made.

    Returns
    -------
    (m, 6) int32 array
        Boxes that cover the same cells, by ascending place.
    """
    sizes = sizes_in(catalogue, colour)
    left = {tuple(box) for box in boxes.tolist()}
    done = []
    for box in sorted(left, key=lambda each: (each[2], each)):
        if box not in left:
            continue
        x, y, z, a, b, height = box
        run = [(x, y, z + height * step, a, b, height) for step in range(TALL // max(height, 1))]
        tall = height == PLATES_PER_BRICK and (max(a, b), min(a, b), TALL) in sizes and left.issuperset(run)
        left.difference_update(run if tall else [box])
        done.append((x, y, z, a, b, TALL) if tall else box)
    return boxes_of(done)


def bricks_of_boxes(boxes: Boxes, catalogue: Catalogue, *, colour: int, role: Role) -> Bricks:
    """Write boxes down as bricks.

    Parameters
    ----------
    boxes : (n, 6) int32 array
        Each of the size of a part.
    catalogue : Catalogue
    colour : int
        LDraw code.
    role : Role

    Returns
    -------
    Bricks
        In the order of the boxes, of piece and step 0.
    """
    sizes = sizes_in(catalogue, colour)
    a, b = boxes[:, 3], boxes[:, 4]
    keys = np.stack([np.maximum(a, b), np.minimum(a, b), boxes[:, 5]], axis=1)
    n = len(boxes)
    return Bricks(
        part=np.array([sizes[tuple(key)] for key in keys.tolist()], dtype=np.int16),
        corner=boxes[:, :3].astype(np.int32),
        turn=(b > a).astype(np.uint8),
        colour=np.full(n, colour, dtype=np.int16),
        role=np.full(n, role, dtype=np.uint8),
        piece=np.zeros(n, dtype=np.int16),
        step=np.zeros(n, dtype=np.int32),
    )
