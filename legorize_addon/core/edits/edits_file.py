"""The edits of a model as one JSON text, to be kept with a build or in a file."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Final, get_args

import numpy as np

from ..errors import EditError, LegorizeError
from ..model import CELL_SIZE, Catalogue
from .edit import TURNS, Edit, Kind, check_edit

VERSION: Final = 1
"""Of the form; raised when earlier versions of Legorize could no longer read it."""

ROUNDING: Final = 1e-3
"""Share of a cell by which the corners of two grids may differ, and of a scale: what rounding does to them."""

_FAR: Final = 100_000
"""Cells from the corner of the grid beyond which a number is a mistake: a model has 1000 at most."""


@dataclass(frozen=True, slots=True)
class Edits:
    """Edits in the order in which they were made, and the grid that they are told in.

    Attributes
    ----------
    edits : tuple of Edit
    scale : float or None
        Model mm per world mm of that grid; None where nobody knows.
    corner : (float, float, float)
        Of its cell 0, in mm of the scaled model.
    """

    edits: tuple[Edit, ...] = ()
    scale: float | None = None
    corner: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __len__(self) -> int:
        """Return the number of edits."""
        return len(self.edits)

    def moved_to(self, scale: float, corner: Sequence[float]) -> Edits | None:
        """Return the edits as they are told in another grid.

        Parameters
        ----------
        scale : float
            Model mm per world mm.
        corner : sequence of three float
            Of its cell 0, in mm of the scaled model.

        Returns
        -------
        Edits or None
            None where the cells of the two grids are not the same: the model has another size, or lies between them.
        """
        x, y, z = map(float, corner)
        if self.scale is None:
            return replace(self, scale=scale, corner=(x, y, z))
        exact = (np.array(self.corner) - np.array([x, y, z])) / CELL_SIZE
        cells = np.rint(exact)
        if abs(self.scale / scale - 1) > ROUNDING or (np.abs(exact - cells) > ROUNDING).any():
            return None
        moved = tuple(replace(each, cell=_moved(each, cells.astype(int).tolist())) for each in self.edits)
        return Edits(moved, scale, (x, y, z))


NO_EDITS: Final = Edits()
"""What a model has that nobody edited."""


def _moved(edit: Edit, by: Sequence[int]) -> tuple[int, int, int]:
    x, y, z = edit.cell
    return x + by[0], y + by[1], z + by[2]


def edits_text(edits: Edits) -> str:
    """Return edits as JSON, one a line.

    Parameters
    ----------
    edits : Edits

    Returns
    -------
    str
        With a newline at the end.
    """
    lines = ",\n".join(f"    {json.dumps(asdict(each))}" for each in edits.edits)
    head = {"version": VERSION, "scale": edits.scale, "corner": list(edits.corner)}
    inner = ",\n".join(f"  {json.dumps(name)}: {json.dumps(value)}" for name, value in head.items())
    return f'{{\n{inner},\n  "edits": [\n{lines}\n  ]\n}}\n'


def read_edits(text: str, catalogue: Catalogue) -> Edits:
    """Return the edits of a JSON text.

    Parameters
    ----------
    text : str
        As :func:`edits_text` writes it; scale and corner may be left out.
    catalogue : Catalogue

    Returns
    -------
    Edits

    Raises
    ------
    EditError
        It is not JSON, was written by a newer version, or an edit makes no sense.
    """
    try:
        read = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise EditError(f"The edits are not valid JSON ({error}): mend the file.") from error
    if not isinstance(read, dict) or not isinstance(read.get("edits"), list):
        raise EditError('The edits are not an object with a list: write them as {"edits": [...]}.')
    if read.get("version", VERSION) != VERSION:
        raise EditError(f"The edits have version {read['version']}, but {VERSION} can be read: update Legorize.")
    scale, corner = read.get("scale"), read.get("corner", [0, 0, 0])
    if not (scale is None or (_number(scale) and scale > 0)):
        raise EditError(f"The scale of the edits is {scale!r}: write a number above 0, or leave it out.")
    if not (isinstance(corner, list) and len(corner) == 3 and all(map(_number, corner))):
        raise EditError(f"The corner of the edits is {corner!r}: write three numbers, or leave it out.")
    edits = tuple(_edit(each, number, catalogue) for number, each in enumerate(read["edits"], start=1))
    x, y, z = map(float, corner)
    return Edits(edits, None if scale is None else float(scale), (x, y, z))


def _edit(read: Any, number: int, catalogue: Catalogue) -> Edit:
    """Return one edit, checked."""
    if not isinstance(read, dict):
        raise EditError(f'Edit {number} is {read!r}: write it as {{"kind": "lock", ...}}.')
    kind: Any = read.get("kind")
    part, turn = read.get("part"), read.get("turn", 0)
    cell, colour = read.get("cell"), read.get("colour", 0)
    if kind not in get_args(Kind):
        raise EditError(f"Edit {number} has the kind {kind!r}: choose one of {', '.join(get_args(Kind))}.")
    if not isinstance(part, str):
        raise EditError(f"Edit {number} has the part {part!r}: write an LDraw number as text, such as '3001'.")
    if not (_whole(turn) and 0 <= turn < TURNS):
        raise EditError(f"Edit {number} has the turn {turn!r}: choose 0, 1, 2 or 3.")
    if not (isinstance(cell, list) and len(cell) == 3 and all(_whole(each) and abs(each) < _FAR for each in cell)):
        raise EditError(f"Edit {number} has the cell {cell!r}: write three whole numbers, x, y and z.")
    if not _whole(colour):
        raise EditError(f"Edit {number} has the colour {colour!r}: write an LDraw code.")
    x, y, z = cell
    found = Edit(kind, part, turn, (x, y, z), colour)
    try:
        check_edit(found, catalogue)
    except LegorizeError as error:
        raise EditError(f"Edit {number} cannot be used: {error}") from error
    return found


def _whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _number(value: Any) -> bool:
    # the negated form also refuses not-a-number
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < float("inf")
