"""What edits by hand mean for a run: they are made once the layout holds, so that no layout is made anew for them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from .edits import Edit, Edits, Outcome, apply_edits, outcomes_of
from .layout import owners_of
from .model import COLOUR_EMPTY, NOBODY, Assembly, Bricks, Catalogue, Fill, Role, UnitGrid
from .run import Run

OTHER_GRID: Final = "the model has another size now, or lies otherwise in its grid"


@dataclass(frozen=True, slots=True, eq=False)
class ByHand:
    """Edits, and what became of them in a layout.

    Attributes
    ----------
    edits : Edits
        In the grid of the model, if they fit it.
    refused : mapping of int to str
        Numbers of those that could not be made, and why.
    before : Bricks
        The layout without them.
    """

    edits: Edits
    refused: Mapping[int, str]
    before: Bricks

    @property
    def made(self) -> tuple[Edit, ...]:
        """Those that were made."""
        return tuple(each for number, each in enumerate(self.edits.edits) if number not in self.refused)

    def outcomes(self, assembly: Assembly) -> tuple[Outcome, ...]:
        """Return what a finished model has of them."""
        return outcomes_of(assembly.bricks, assembly.catalogue, self.edits.edits, self.refused)


def edit_bricks(
    run: Run, edits: Edits, scale: float, bricks: Bricks, shell: UnitGrid
) -> tuple[Bricks, UnitGrid, ByHand]:
    """Make edits in a layout.

    Parameters
    ----------
    run : Run
    edits : Edits
        In their own grid.
    scale : float
        Model mm per world mm.
    bricks : Bricks
    shell : UnitGrid
        The cells that they cover.

    Returns
    -------
    bricks : Bricks
        The same object if nothing was edited.
    shell : UnitGrid
        The cells that they cover now.
    by_hand : ByHand
    """
    moved = edits.moved_to(scale, shell.origin.tolist())
    if moved is None:
        return bricks, shell, ByHand(edits, dict.fromkeys(range(len(edits)), OTHER_GRID), bricks)
    shape = (-1, *shell.colour.shape[2:])
    planes = shell.colour.reshape(shape).shape
    made, refused = apply_edits(bricks, run.parts.joining, moved.edits, shape=planes)
    if made is not bricks:
        shell = _as_built(shell, made, run.catalogue)
    return made, shell, ByHand(moved, refused, bricks)


def _as_built(shell: UnitGrid, bricks: Bricks, catalogue: Catalogue) -> UnitGrid:
    """Return the cells that bricks fill, in their colours where those of the cells count."""
    owner = owners_of(bricks, shell, catalogue)[1:-1].reshape(shell.colour.shape)
    filled = owner != NOBODY
    added, gone = filled & ~shell.solid, ~filled & (shell.cover == Fill.REQUIRED)
    colour = np.where(filled & (shell.colour >= 0) | added, bricks.colour[owner], shell.colour)
    return replace(
        shell,
        colour=np.where(gone, np.int16(COLOUR_EMPTY), colour),
        cover=np.where(added, np.uint8(Fill.REQUIRED), np.where(gone, np.uint8(Fill.EMPTY), shell.cover)),
        role=np.where(added, np.uint8(Role.PLATE), shell.role),
    )
