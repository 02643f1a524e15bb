"""Bricks as a text that a build keeps: what it would be without the changes that were made by hand."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Sequence
from typing import Final

import numpy as np

from ..core.model import Bricks, Catalogue

_COLUMNS: Final = 9
"""Whole numbers of a brick: part, three of its corner, turn, colour, role, piece, step."""


def bricks_text(bricks: Bricks) -> str:
    """Return bricks as a packed text."""
    columns = [bricks.part, *bricks.corner.T, bricks.turn, bricks.colour, bricks.role, bricks.piece, bricks.step]
    table = np.stack([column.astype("<i4") for column in columns])
    return base64.b85encode(zlib.compress(table.tobytes())).decode("ascii")


def read_bricks_text(text: str, part_numbers: Sequence[str], catalogue: Catalogue) -> Bricks:
    """Return what :func:`bricks_text` packed.

    Parameters
    ----------
    text : str
    part_numbers : sequence of str
        LDraw numbers of the parts, by the rows that were meant.
    catalogue : Catalogue
        Parts and colours of today.

    Returns
    -------
    Bricks

    Raises
    ------
    BuildError
        A part number is not in the catalogue.
    """
    table = np.frombuffer(zlib.decompress(base64.b85decode(text)), dtype="<i4").reshape(_COLUMNS, -1)
    part, x, y, z, turn, colour, role, piece, step = table
    rows = np.array([catalogue.part_row(number) for number in part_numbers], dtype=np.int16)
    return Bricks(
        part=rows[part],
        corner=np.stack([x, y, z], axis=1).astype(np.int32),
        turn=turn.astype(np.uint8),
        colour=colour.astype(np.int16),
        role=role.astype(np.uint8),
        piece=piece.astype(np.int16),
        step=step.astype(np.int32),
    )
