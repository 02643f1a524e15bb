"""Where a builder finds something: columns and rows as on the layer maps, layers, and steps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..arrays import Mask
from ..instructions import lettered
from ..model import Assembly, components, stud_columns
from .remarks import layer_of

SHOWN: Final = 12
"""Places that a sentence names."""


def square_name(assembly: Assembly, row: int) -> str:
    """Return column and row of a brick's first stud, as they stand at the edges of the layer maps: "12 C".

    Parameters
    ----------
    assembly : Assembly
        All that the maps show: the model and its supports.
    row : int
        The brick.

    Returns
    -------
    str
        The number of the column and the letters of the row, counted from the front left corner of all bricks.
    """
    brick, squares = stud_columns(assembly.bricks, assembly.catalogue)
    x, y = (squares[brick == row, :2].min(axis=0) - squares[:, :2].min(axis=0)).tolist()
    return f"{x + 1} {lettered(y)}"


def pillar_places(assembly: Assembly, which: Mask) -> list[str]:
    """Say where bricks are that stand on each other, a place a pillar.

    Parameters
    ----------
    assembly : Assembly
        All that the maps show, each brick with its step.
    which : (n,) bool array
        The bricks.

    Returns
    -------
    list of str
        As "12 C in layers 1 to 5 (step 14)", by the step of the first brick, from 1.
    """
    bricks, pairs = assembly.bricks, assembly.graph.pairs
    pillar = components(pairs[which[pairs].all(axis=1)], len(bricks))
    found = []
    for number in np.unique(pillar[which]).tolist():
        rows = np.flatnonzero((pillar == number) & which)
        low, high = (int(rows[best(bricks.corner[rows, 2])]) for best in (np.argmin, np.argmax))
        layers = [layer_of(bricks, each) for each in (low, high)]
        step = int(bricks.step[rows].min()) + 1
        span = f"layer {layers[0]}" if layers[0] == layers[1] else f"layers {layers[0]} to {layers[1]}"
        found.append((step, f"{square_name(assembly, low)} in {span} (step {step})"))
    return [text for _, text in sorted(found)]


def listed(places: Sequence[str]) -> str:
    """Return places as the end of a sentence that names the layer maps, only the first of many."""
    more = f" and {len(places) - SHOWN} more" if len(places) > SHOWN else ""
    return f"on the layer maps at {', '.join(places[:SHOWN])}{more}"
