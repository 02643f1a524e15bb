"""The building order as a table, ``build_order.csv``."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Mask
from ..building import Action, Steps
from ..model import Assembly, Role
from ..safe_text import csv_text
from .ldraw import brick_lines

COLUMNS: Final = ("step", "action", "piece", "role", "ldraw", "pressed", "by_hand", "assembly", "onto")


def build_order_csv(steps: Steps, assembly: Assembly, *, by_hand: Mask) -> str:
    """Write the moves of a model down, one a row.

    Parameters
    ----------
    steps : Steps
        The order.
    assembly : Assembly
        Model and supports that its rows mean.
    by_hand : (n_moves,) bool array
        Moves at which something has to be held by hand.

    Returns
    -------
    str
        Columns ``step`` (from 1), ``action`` (place, remove or join), ``piece``,
        ``role``, ``ldraw`` (the line of the brick in the frame of the model's
        own file; nothing of a join), ``pressed`` (1 where a brick is pressed
        from below, else 0), ``by_hand`` (1 where something has to be held, else
        0), ``assembly`` (what the brick is placed into or taken from, or what is
        joined: the name of its model in ``model.mpd``) and ``onto`` (what is
        joined to, nothing of a brick). Followed to its end the table leaves the
        finished model.
    """
    moves = steps.moves
    lines = brick_lines(assembly)
    roles = [Role(role).name.lower() for role in assembly.bricks.role.tolist()]
    rows = []
    columns = (moves.step + 1, moves.action, moves.piece, moves.brick, moves.pressed, by_hand, moves.submodel)
    for step, action, piece, row, *told, number in zip(*(np.asarray(each).tolist() for each in columns), strict=True):
        submodel = steps.submodels[number]
        joins = action == Action.JOIN
        brick = ("", "") if joins else (roles[row], lines[row])
        onto = steps.submodels[submodel.parent].name if joins else ""
        rows.append((step, Action(action).name.lower(), piece, *brick, *map(int, told), submodel.name, onto))
    return csv_text(COLUMNS, rows, line_end="\r\n")
