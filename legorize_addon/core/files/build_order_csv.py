"""The building order as a table, ``build_order.csv``."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..building import Action, Moves
from ..model import Bricks, Catalogue, Role
from ..safe_text import csv_text
from .ldraw import brick_lines

COLUMNS: Final = ("step", "action", "piece", "role", "ldraw")


def build_order_csv(moves: Moves, bricks: Bricks, catalogue: Catalogue) -> str:
    """Write the moves of a model down, one a row.

    Parameters
    ----------
    moves : Moves
        The order.
    bricks : Bricks
        Model and supports that its rows mean.
    catalogue : Catalogue

    Returns
    -------
    str
        Columns ``step`` (from 1), ``action`` (place, remove or join), ``piece``,
        ``role``, ``ldraw`` (the line of the brick in the frame of the model's
        own file; nothing of a join). Followed to its end the table leaves the
        finished model.
    """
    lines = brick_lines(bricks, catalogue)
    roles = [Role(role).name.lower() for role in bricks.role.tolist()]
    rows = []
    columns = (moves.step + 1, moves.action, moves.piece, moves.brick)
    for step, action, piece, row in zip(*(np.asarray(column).tolist() for column in columns), strict=True):
        brick = ("", "") if action == Action.JOIN else (roles[row], lines[row])
        rows.append((step, Action(action).name.lower(), piece, *brick))
    return csv_text(COLUMNS, rows, line_end="\r\n")
