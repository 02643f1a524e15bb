"""The building steps of a build, as plain values that Blender keeps in the file, and back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from ..core.building import Kind, Moves, Steps, Submodel

_MOVES: Final = {
    "action": np.uint8,
    "brick": np.int32,
    "piece": np.int16,
    "submodel": np.int32,
    "pressed": np.bool_,
    "step": np.int32,
}
"""Columns of the moves, and what each is."""

_SUBMODELS: Final = ("kind", "parent", "piece", "like")


def stored_steps(steps: Steps) -> dict[str, list[int]]:
    """Return steps as lists of whole numbers.

    Parameters
    ----------
    steps : Steps

    Returns
    -------
    dict of str to list of int
    """
    moves = {name: getattr(steps.moves, name).astype(int).tolist() for name in _MOVES}
    submodels = {f"of_{name}": [int(getattr(each, name)) for each in steps.submodels] for name in _SUBMODELS}
    rows = [row for each in steps.submodels for row in each.rows.tolist()]
    return moves | submodels | {"rows": rows, "count": [len(each.rows) for each in steps.submodels]}


def read_steps(stored: Mapping[str, Any], n_bricks: int) -> Steps | None:
    """Return what :func:`stored_steps` wrote.

    Parameters
    ----------
    stored : mapping of str to sequence of int
    n_bricks : int
        Bricks that are there now.

    Returns
    -------
    Steps or None
        None where nothing was kept, as by earlier versions, or where bricks
        were deleted since: then rows mean other bricks.
    """
    if not {*_MOVES, *(f"of_{name}" for name in _SUBMODELS), "rows", "count"} <= stored.keys():
        return None
    rows = np.array(_numbers(stored["rows"]), dtype=np.int64)
    if len(rows) != n_bricks or not np.array_equal(np.sort(rows), np.arange(n_bricks)):
        return None
    ends = np.cumsum(_numbers(stored["count"]))
    columns = zip(*(_numbers(stored[f"of_{name}"]) for name in _SUBMODELS), np.split(rows, ends[:-1]), strict=True)
    submodels = tuple(
        Submodel(number, Kind(kind), parent, piece, own, like)
        for number, (kind, parent, piece, like, own) in enumerate(columns)
    )
    moves = Moves(**{name: np.array(_numbers(stored[name])).astype(kind) for name, kind in _MOVES.items()})
    return Steps(moves, submodels)


def n_stored(stored: Mapping[str, Any]) -> int:
    """Return for how many bricks :func:`stored_steps` has written steps; 0 where nothing was kept."""
    return len(stored.get("rows", ()))


def _numbers(values: Sequence[int]) -> list[int]:
    return [int(value) for value in values]
