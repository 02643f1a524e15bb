"""One change that a person made by hand, told by the place in the grid, so that it survives another layout."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import EditError
from ..model import Bricks, Catalogue, Part, Role, footprint
from ..units import PLATES_PER_BRICK

Kind = Literal["recolour", "delete", "force", "lock", "forbid"]
Cell = tuple[int, int, int]
"""x and y in studs, z in plates."""

LAYS: Final = ("force", "lock")
"""Kinds that put a brick at a place."""

WORDS: Final[dict[Kind, str]] = {
    "recolour": "Recolour",
    "delete": "Delete",
    "force": "Lay",
    "lock": "Lock",
    "forbid": "Forbid",
}
"""What people call each kind."""

TURNS: Final = 4
"""Quarter turns of a whole one."""


@dataclass(frozen=True, slots=True)
class Edit:
    """A part at a place, and what is to become of the cells there.

    Attributes
    ----------
    kind : str
        ``"recolour"``: the cells have a colour, whatever bricks they are in.
        ``"delete"``: they are empty. ``"force"``: this brick lies there.
        ``"lock"``: the same, as long as the model fills all of its cells.
        ``"forbid"``: this part, however turned, covers none of the cells.
    part : str
        LDraw number: the outline of the cells, or what lies there or may not.
    turn : int
        Quarter turns of the part.
    cell : (int, int, int)
        Lowest corner of its bounding box in the grid: x and y in studs, z in plates.
    colour : int
        LDraw code; of no meaning for what is deleted or forbidden.
    """

    kind: Kind
    part: str
    turn: int
    cell: Cell
    colour: int

    def part_of(self, catalogue: Catalogue) -> Part:
        """Return the part.

        Raises
        ------
        BuildError
            The catalogue does not have it.
        """
        return catalogue.parts[catalogue.part_row(self.part)]

    def cells(self, catalogue: Catalogue) -> Set[Cell]:
        """Return the cells that it is about."""
        part, (x, y, z) = self.part_of(catalogue), self.cell
        squares = footprint(part, self.turn).tolist()
        return {(x + i, y + j, z + k) for i, j in squares for k in range(part.height)}

    def brick(self, catalogue: Catalogue) -> Bricks:
        """Return the brick that it lays, as a table of one row."""
        return Bricks(
            part=np.array([catalogue.part_row(self.part)], dtype=np.int16),
            corner=np.array([self.cell], dtype=np.int32),
            turn=np.array([self.turn], dtype=np.uint8),
            colour=np.array([self.colour], dtype=np.int16),
            role=np.array([Role.SHELL], dtype=np.uint8),
            piece=np.zeros(1, dtype=np.int16),
            step=np.array([self.cell[2] // PLATES_PER_BRICK], dtype=np.int32),
        )

    def rows_of(self, bricks: Bricks, catalogue: Catalogue, *, coloured: bool = True) -> NDArray[np.intp]:
        """Return the rows of the bricks that are the one it lays, at most one if none overlap."""
        part = self.part_of(catalogue)
        same = bricks.part == catalogue.part_row(self.part)
        same &= (bricks.corner == np.array(self.cell)).all(axis=1)
        same &= bricks.turn % part.turns == self.turn % part.turns
        if coloured:
            same &= bricks.colour == self.colour
        return np.flatnonzero(same)

    def told(self, catalogue: Catalogue) -> str:
        """Say what it is and where: "Recolour Brick 2 x 4 to Red in layer 3 at column 5, row 2 of the grid"."""
        x, y, z = self.cell
        where = f"in layer {z // PLATES_PER_BRICK + 1} at column {x + 1}, row {y + 1} of the grid"
        return f"{self.what(catalogue)} {where}"

    def what(self, catalogue: Catalogue) -> str:
        """Say what it is: "Recolour Brick 2 x 4 to Red"."""
        what = f"{WORDS[self.kind]} {self.part_of(catalogue).title}"
        if self.kind == "recolour":
            what += f" to {catalogue.colours[catalogue.colour_row(self.colour)].name}"
        return what


def edit_of(kind: Kind, bricks: Bricks, row: int, catalogue: Catalogue, colour: int | None = None) -> Edit:
    """Return an edit of a brick.

    Parameters
    ----------
    kind : str
    bricks : Bricks
    row : int
        Of the brick.
    catalogue : Catalogue
    colour : int, optional
        LDraw code; the brick's own by default.

    Returns
    -------
    Edit
    """
    x, y, z = bricks.corner[row].tolist()
    own = int(bricks.colour[row]) if colour is None else colour
    return Edit(kind, catalogue.parts[bricks.part[row]].number, int(bricks.turn[row]), (x, y, z), own)


def check_edit(edit: Edit, catalogue: Catalogue) -> None:
    """Refuse an edit that no model could have.

    Raises
    ------
    EditError
        The part is not laid in models, or not made in the colour.
    BuildError
        The catalogue does not have the part or the colour.
    """
    part, row = edit.part_of(catalogue), catalogue.colour_row(edit.colour)
    if edit.kind in LAYS and part.use not in ("model", "tiles"):
        raise EditError(f"{part.title} is not laid by hand: choose a brick, a plate or a tile.")
    if edit.kind in LAYS and not catalogue.exists[catalogue.part_row(edit.part), row]:
        raise EditError(f"{part.title} is not made in {catalogue.colours[row].name}: choose another colour or part.")
